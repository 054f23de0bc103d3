# POV-Ray scenes and the stored pictures; and POV-Ray itself, which has to be installed.
strahl_test(povref strahl_povref)
strahl_test(povray strahl_povref)
set_tests_properties(povray PROPERTIES LABELS slow TIMEOUT 600)
