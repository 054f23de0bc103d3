# The language of POV-Ray's scenes.
strahl_tests(test_pov unit/pov strahl_pov pov_language pov_functions pov_limits)
