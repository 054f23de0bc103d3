# Sourced by the tests of the window: runs the calling script on a virtual display of its own.

# own_display SIZE "TOOL..." ARGUMENT...: starts the script again with ARGUMENT... under Xvfb, unless it already runs
# there. Exits with status 77 (skipped) if a tool is missing.
own_display() {
    [[ -z ${STRAHL_OWN_DISPLAY-} ]] || return 0
    local size=$1 tools tool
    read -ra tools <<<"$2"
    for tool in xvfb-run xauth xdotool "${tools[@]}"; do
        command -v "$tool" >/dev/null && continue
        echo "skipped: $tool is missing (Debian packages xvfb, xauth, xdotool, imagemagick, libgl1-mesa-dri)"
        exit 77
    done
    STRAHL_OWN_DISPLAY=yes exec xvfb-run -a -s "-screen 0 ${size}x24" bash "$0" "${@:3}"
}
