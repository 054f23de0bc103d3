// Opens the window with GLFW and draws with OpenGL and ImGui.
#include "show/window/screen.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "show/window/icon.h"

namespace strahl {
namespace {

[[noreturn]] void fail(const std::string& why) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw WindowError("cannot open a window: " + why + (reason ? std::string(" (") + reason + ")" : "") +
                      "\nTo render without a window: strahl render SCENE -o picture.png");
}

/// Loads DejaVu or Liberation Mono if the system has it, else the font of ImGui.
void load_font(float scale) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    // Latin, Greek, Cyrillic, punctuation and arrows: messages quote scene files.
    static constexpr ImWchar ranges[] = {0x20, 0x24f, 0x370, 0x3ff, 0x400, 0x52f, 0x2000, 0x22ff, 0};
    for (const char* path : {"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
                             "/usr/share/fonts/truetype/liberation/LiberationMono-Regular.ttf",
                             "/usr/share/fonts/TTF/DejaVuSansMono.ttf"}) {
        std::error_code error;
        if (std::filesystem::exists(path, error) &&
            fonts.AddFontFromFileTTF(path, std::max(8.f, 15 * scale), nullptr, ranges))
            return;
    }
    ImFontConfig config;
    config.SizePixels = std::max(8.f, 13 * scale);
    fonts.AddFontDefault(&config);
}

/// Returns the monitor that shows this point, or null.
GLFWmonitor* monitor_at(int x, int y) {
    int count = 0;
    GLFWmonitor* const* const monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        if (mode && x >= left && x < left + mode->width && y >= top && y < top + mode->height) return monitors[i];
    }
    return nullptr;
}

void set_icon(GLFWwindow* window) {
    ScreenImage images[] = {icon(16), icon(32), icon(48), icon(128)};
    std::array<GLFWimage, std::size(images)> icons;
    for (std::size_t i = 0; i < icons.size(); ++i)
        icons[i] = {images[i].width, images[i].height, reinterpret_cast<unsigned char*>(images[i].pixels.data())};
    glfwSetWindowIcon(window, static_cast<int>(icons.size()), icons.data());
}

/// Returns where the pointer is, in units of the screen, if the window has the keys.
std::optional<glm::dvec2> pointer_now(GLFWwindow* window) {
    if (!glfwGetWindowAttrib(window, GLFW_FOCUSED)) return std::nullopt;
    glm::dvec2 at{};
    glfwGetCursorPos(window, &at.x, &at.y);
    return at;
}

/// Tells ImGui where the pointer is, in units of the screen, while it counts in pixels, and in the next frame all that
/// has happened. From 1.87 on ImGui has a queue of events, which replaces what is written into its state, and which by
/// default it takes in several frames; before, it asks for the left button by itself.
template <class Io>
void show_pointer(Io& io, const std::optional<glm::dvec2>& place, const std::optional<bool>& left_down) {
    ImVec2 at(-FLT_MAX, -FLT_MAX);  // outside
    if (place)
        at = {static_cast<float>(place->x) * io.DisplayFramebufferScale.x,
              static_cast<float>(place->y) * io.DisplayFramebufferScale.y};
    if constexpr (requires { io.AddMousePosEvent(at.x, at.y); }) {
        io.ConfigInputTrickleEventQueue = false;
        io.AddMousePosEvent(at.x, at.y);
    } else {
        io.MousePos = at;
        if (left_down) io.MouseDown[0] = *left_down;
    }
}

void set_style(float scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 6;
    style.WindowBorderSize = 0;
    style.WindowPadding = {12, 10};
    style.ItemSpacing = {10, 5};
    style.FrameRounding = 3;
    style.Colors[ImGuiCol_WindowBg] = {0.05f, 0.06f, 0.08f, 0.80f};
    style.Colors[ImGuiCol_PlotHistogram] = {0.36f, 0.68f, 0.93f, 1};
    style.Colors[ImGuiCol_FrameBg] = {1, 1, 1, 0.12f};
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

}  // namespace

/// Loaded through GLFW, so that the program need not be linked with OpenGL.
struct Screen::Functions {
    struct Found {
        const char* name;
        template <class F>
        operator F*() const {
            const auto function = reinterpret_cast<F*>(glfwGetProcAddress(name));
            if (!function) fail(std::string("its OpenGL lacks ") + name);
            return function;
        }
    };
    decltype(&::glGetString) GetString = Found{"glGetString"};
    decltype(&::glGenTextures) GenTextures = Found{"glGenTextures"};
    decltype(&::glDeleteTextures) DeleteTextures = Found{"glDeleteTextures"};
    decltype(&::glBindTexture) BindTexture = Found{"glBindTexture"};
    decltype(&::glTexImage2D) TexImage2D = Found{"glTexImage2D"};
    decltype(&::glTexParameteri) TexParameteri = Found{"glTexParameteri"};
    decltype(&::glTexSubImage2D) TexSubImage2D = Found{"glTexSubImage2D"};
    PFNGLGENFRAMEBUFFERSPROC GenFramebuffers = Found{"glGenFramebuffers"};
    PFNGLDELETEFRAMEBUFFERSPROC DeleteFramebuffers = Found{"glDeleteFramebuffers"};
    PFNGLBINDFRAMEBUFFERPROC BindFramebuffer = Found{"glBindFramebuffer"};
    PFNGLFRAMEBUFFERTEXTURE2DPROC FramebufferTexture2D = Found{"glFramebufferTexture2D"};
    PFNGLBLITFRAMEBUFFERPROC BlitFramebuffer = Found{"glBlitFramebuffer"};
    decltype(&::glViewport) Viewport = Found{"glViewport"};
    decltype(&::glClearColor) ClearColor = Found{"glClearColor"};
    decltype(&::glClear) Clear = Found{"glClear"};
};

/// A picture that is copied into the window, without shaders. Software OpenGL copies memory for that if the pixels have
/// the order of the window's. The texture gets that order because it is made with this format of pixels and with no
/// other of its own; of Mesa's llvmpipe, 1920x1080 then takes 4 ms of processor time to show instead of 30.
struct Screen::Surface {
    const Functions& gl;
    unsigned texture = 0, framebuffer = 0;
    int width = 0, height = 0;

    explicit Surface(const Functions& functions) : gl(functions) {
        gl.GenTextures(1, &texture);
        gl.GenFramebuffers(1, &framebuffer);
    }
    ~Surface() {
        gl.DeleteFramebuffers(1, &framebuffer);
        gl.DeleteTextures(1, &texture);
    }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    void upload(const ScreenImage& image, int first_row, int rows) {
        constexpr GLenum format = GL_BGRA, type = GL_UNSIGNED_INT_8_8_8_8_REV;
        gl.BindTexture(GL_TEXTURE_2D, texture);
        if (image.width == width && image.height == height)
            return gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, first_row, width, rows, format, type,
                                    &image.pixels[std::size_t(first_row) * width]);
        width = image.width, height = image.height;
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, format, type, image.pixels.data());
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        gl.FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    }

    /// Copies the picture from one of its columns on to an area of a window with so many rows. Scales it where the
    /// window has just got another size, and what the camera of the flight sees in motion.
    void copy(int first_column, const ScreenArea& to, int window_rows) const {
        const bool same = width - first_column == to.width && height == to.height;
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        gl.BlitFramebuffer(first_column, 0, width, height, to.x, window_rows - to.y, to.x + to.width,
                           window_rows - to.y - to.height, GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    }
};

Screen::Screen(const std::string& title, PictureSize size, bool default_size, bool full, bool framed) {
    if (!glfwInit()) fail("no display");
    glfwWindowHint(GLFW_DECORATED, framed ? GLFW_TRUE : GLFW_FALSE);
    try {
        make_window(title, size, default_size, full);
        start_drawing();
        draw_picture();
    } catch (...) {
        picture.reset(), gl.reset();
        glfwTerminate();
        throw;
    }
}

void Screen::make_window(const std::string& title, PictureSize size, bool default_size, bool full) {
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, default_size);
    glfwWindowHint(GLFW_RED_BITS, 8);
    glfwWindowHint(GLFW_GREEN_BITS, 8);
    glfwWindowHint(GLFW_BLUE_BITS, 8);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // full screen stays when another window gets the focus
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "Strahl");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "strahl");
    glfw = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    if (!glfw) fail("no OpenGL");
    set_icon(glfw);
    opened = window_state();
    if (default_size) restore();
    glfwMakeContextCurrent(glfw);
    gl = std::make_unique<Functions>();
    const auto* version = reinterpret_cast<const char*>(gl->GetString(GL_VERSION));
    int major = 0;
    if (!version || std::sscanf(version, "%d", &major) != 1 || major < 3)
        fail("OpenGL 3.0 is required, and this is " + std::string(version ? version : "none"));
    glfwSwapInterval(1);
    if (full) toggle_full_screen();
}

void Screen::start_drawing() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    ImGui_ImplGlfw_InitForOpenGL(glfw, false);
    if (!ImGui_ImplOpenGL3_Init("#version 130")) {
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
        fail("its OpenGL cannot be used");
    }
    picture = std::make_unique<Surface>(*gl);
}

Screen::~Screen() {
    picture.reset(), second_picture.reset();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwTerminate();
}

int Screen::width() const {
    int pixels = 0;
    glfwGetFramebufferSize(glfw, &pixels, nullptr);
    return glfwGetWindowAttrib(glfw, GLFW_ICONIFIED) ? 0 : pixels;
}

int Screen::height() const {
    int pixels = 0;
    glfwGetFramebufferSize(glfw, nullptr, &pixels);
    return glfwGetWindowAttrib(glfw, GLFW_ICONIFIED) ? 0 : pixels;
}

void Screen::upload(const Fresh& fresh) { picture->upload(fresh.image, fresh.first_row, fresh.rows); }

void Screen::show_second(std::shared_ptr<const ScreenImage> image, const ScreenArea& part, bool whole) {
    second_part = part, second_whole = whole;
    if (image == second) return;
    second = std::move(image);
    if (!second) return;
    if (!second_picture) second_picture = std::make_unique<Surface>(*gl);
    second_picture->upload(*second, 0, second->height);
}

/// The texture has bytes in the order R, G, B, A: of others Mesa 22.3's llvmpipe draws only parts.
unsigned Screen::make_texture(const ScreenImage& image) const {
    unsigned texture = 0;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                   image.pixels.data());
    return texture;
}

void Screen::copy_pictures() const {
    const int columns = width(), rows = height();
    gl->Viewport(0, 0, columns, rows);
    const bool shown = picture->width > 0;
    const ScreenArea all = area();
    if (!shown || all.width != columns || all.height != rows) {
        const float brightness = shown ? 0 : 0.12f;  // grey, until there is a picture
        gl->ClearColor(brightness, brightness, brightness, 1);
        gl->Clear(GL_COLOR_BUFFER_BIT);
    }
    if (!shown) return;
    picture->copy(0, all, height());
    if (!second) return;
    const int hidden = second_whole ? 0 : second->width * (second_part.x - all.x) / all.width;
    second_picture->copy(hidden, second_part, height());
}

void Screen::draw_picture() const {
    if (width() == 0 || height() == 0) return;
    copy_pictures();
    glfwSwapBuffers(glfw);
}

void Screen::draw(const std::function<void()>& overlay) {
    float wanted = 1;
    glfwGetWindowContentScale(glfw, &wanted, nullptr);
    wanted = std::clamp(wanted, 0.5f, 4.f);
    if (wanted != scale) {
        scale = wanted;
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        load_font(scale);
    }
    const int columns = width(), rows = height();
    if (columns == 0 || rows == 0) return;
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    show_pointer(io, pointer ? pointer : pointer_now(glfw), left_down);
    io.DisplaySize = {static_cast<float>(columns), static_cast<float>(rows)};
    io.DisplayFramebufferScale = {1, 1};
    // A press, its release and the next press are taken by three drawings: slow ones must not part a double click.
    io.MouseDoubleClickTime = static_cast<float>(std::clamp(3 * interval, 0.3, 1.5));
    const double now = glfwGetTime();
    interval = now - std::exchange(drawn, now);
    // In a small window the panels shrink before they overlap, and the spaces in them to those of 96 dpi.
    const float fits = std::min(io.DisplaySize.x / 760, io.DisplaySize.y / 570);
    const float text = std::clamp(fits, std::min(0.5f, scale), scale);
    io.FontGlobalScale = text / scale;
    set_style(std::max(text, std::min(scale, 1.f)));
    ImGui_ImplOpenGL3_NewFrame();
    if (!io.Fonts->TexID) ImGui_ImplOpenGL3_CreateFontsTexture();
    ImGui::NewFrame();
    overlay();
    ImGui::Render();
    copy_pictures();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(glfw);
}

WindowState Screen::window_state() const {
    WindowState state;
    glfwGetWindowPos(glfw, &state.x, &state.y);
    glfwGetWindowSize(glfw, &state.width, &state.height);
    return state;
}

/// Moves the window to where it was closed last, unless that is no longer on a monitor.
void Screen::restore() {
    const auto last = read_window_state();
    if (!last || !monitor_at(last->x + last->width / 2, last->y + 1)) return;
    if (last->width > 0) glfwSetWindowSize(glfw, last->width, last->height);
    glfwSetWindowPos(glfw, last->x, last->y);
}

void Screen::remember() const {
    WindowState state = full_screen() ? before : window_state();
    if (state.width == opened.width && state.height == opened.height) state.width = state.height = 0;
    write_window_state(state);
}

void Screen::hide() { glfwHideWindow(glfw); }

bool Screen::full_screen() const { return glfwGetWindowMonitor(glfw); }

ScreenArea Screen::area() const {
    if (picture->width == 0) return {0, 0, width(), height()};
    return fitted(static_cast<double>(picture->width) / picture->height, width(), height());
}

void Screen::toggle_full_screen() {
    if (full_screen()) {
        glfwSetWindowMonitor(glfw, nullptr, before.x, before.y, before.width, before.height, GLFW_DONT_CARE);
        return;
    }
    before = window_state();
    GLFWmonitor* chosen = monitor_at(before.x + before.width / 2, before.y + before.height / 2);
    if (!chosen) chosen = glfwGetPrimaryMonitor();
    if (!chosen) return;
    const GLFWvidmode* mode = glfwGetVideoMode(chosen);
    if (mode) glfwSetWindowMonitor(glfw, chosen, 0, 0, mode->width, mode->height, mode->refreshRate);
}

}  // namespace strahl
