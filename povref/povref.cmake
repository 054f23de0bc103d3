# Conversion to POV-Ray, and comparison of the two programs' pictures.
strahl_module(povref povref strahl_scene strahl_text strahl_trace strahl_image)
