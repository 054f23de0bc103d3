# Scenes of POV-Ray.
strahl_tests(test_pov unit/pov strahl_pov pov_mistakes pov_bodies pov_appearance pov_patterns pov_pictures pov_animation expand literals)
