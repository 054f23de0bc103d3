# Conversion to POV-Ray and stored pictures; and POV-Ray itself, which must be installed.
strahl_test(povref strahl_povref)
strahl_test(povref_agreement strahl_povref)
strahl_test(povray strahl_povref)
set_tests_properties(povray PROPERTIES LABELS slow TIMEOUT 600)
