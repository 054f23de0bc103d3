# POV-Ray as the referee: scenes for it, and the two programs' pictures against each other.
strahl_module(povref povref strahl_scene strahl_text strahl_trace strahl_image)
