# Pictures: the plain part, and a module with OpenImageIO in it that is loaded only when a picture file is needed.
strahl_room(image src/image)
