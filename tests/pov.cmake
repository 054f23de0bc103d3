# Scenes of POV-Ray, and their language.
strahl_tests(test_pov unit/pov strahl_pov)
