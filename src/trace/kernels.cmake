# The tracer: its plain part, and the kernel compiled once per instruction set.
strahl_room(trace src/trace strahl_scene)
