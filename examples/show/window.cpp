// See window.h. OpenGL as it is everywhere, software renderers included: fixed functions and arrays of the program's.
#include "show/window.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl2.h>
#include <imgui.h>
#include <Eigen/Geometry>

namespace show {
namespace {

struct Vertex {
    float position[3];
    float normal[3];
};

struct Mark {
    float position[3];
    float colour[3];
};

void set_light(GLenum number, float x, float y, float z, float red, float green, float blue) {
    const float place[] = {x, y, z, 0}, colour[] = {red, green, blue, 1};
    glEnable(number);
    glLightfv(number, GL_POSITION, place);
    glLightfv(number, GL_DIFFUSE, colour);
}

/// Linear light to what a display takes, roughly.
float shown(float linear) { return std::sqrt(std::clamp(linear, 0.0f, 1.0f)); }

Mark mark(const Point& place, const Colour& colour) {
    return {{static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())},
            {shown(colour.x()), shown(colour.y()), shown(colour.z())}};
}

void draw_marks(const std::vector<Mark>& marks, GLenum mode) {
    if (marks.empty()) return;
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof(Mark), marks.front().position);
    glColorPointer(3, GL_FLOAT, sizeof(Mark), marks.front().colour);
    glDrawArrays(mode, 0, static_cast<GLsizei>(marks.size()));
    glDisableClientState(GL_COLOR_ARRAY);
    glDisableClientState(GL_VERTEX_ARRAY);
}

/// Round, and as large as they are in the middle of the mesh, where a unit is `pixels` long; small ones can be seen.
void draw_dots(std::span<const Dot> dots, double pixels) {
    std::map<double, std::vector<Mark>> marks;  // of each radius
    for (const Dot& dot : dots) marks[dot.radius].push_back(mark(dot.place, dot.colour));
    glEnable(GL_POINT_SMOOTH);
    glEnable(GL_ALPHA_TEST);
    glAlphaFunc(GL_GREATER, 0.5f);
    for (const auto& [radius, same] : marks) {
        glPointSize(static_cast<float>(std::max(2 * radius * pixels, 2.0)));
        draw_marks(same, GL_POINTS);
    }
    glDisable(GL_ALPHA_TEST);
    glDisable(GL_POINT_SMOOTH);
}

/// The frame that is about to be shown, its rows turned over: OpenGL has the lowest first.
Image what_is_seen(int width, int height) {
    Image image{width, height, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width * height))};
    std::vector<std::uint8_t> upside_down(image.rgb.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
    const auto row = static_cast<std::ptrdiff_t>(3) * width;
    for (int y = 0; y < height; ++y)
        std::copy_n(upside_down.begin() + (height - 1 - y) * row, row, image.rgb.begin() + y * row);
    return image;
}

}  // namespace

struct Window::Impl {
    View view;
    GLFWwindow* window = nullptr;
    std::vector<Vertex> vertices;
    Paint paint;
    Eigen::AlignedBox3d box;
    Eigen::Array2d shift = Eigen::Array2d::Zero();

    void follow_mouse() {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantCaptureMouse) return;
        if (io.MouseDown[0]) {
            view.azimuth -= 0.4 * static_cast<double>(io.MouseDelta.x);
            view.elevation = std::clamp(view.elevation + 0.4 * static_cast<double>(io.MouseDelta.y), -89.0, 89.0);
        }
        if (io.MouseDown[1])
            shift += Eigen::Array2d(static_cast<double>(io.MouseDelta.x), -static_cast<double>(io.MouseDelta.y)) * 2e-3;
        view.zoom *= std::pow(1.1, static_cast<double>(io.MouseWheel));
    }

    /// The camera of the pictures, as OpenGL takes one. Returns how many pixels a unit has in the middle of the mesh.
    double set_camera(int width, int height) {
        view.width = std::max(width, 1);
        view.height = std::max(height, 1);
        std::vector<Point> corners;
        for (int k = 0; k < 8; ++k)
            corners.push_back(box.isEmpty() ? Point::Zero() : box.corner(static_cast<decltype(box)::CornerType>(k)));
        const Camera camera(corners, view);
        const double near = camera.depth() / 500, far = 2 * camera.depth();
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glTranslated(shift.x(), shift.y(), 0);
        const double right = near * camera.tangent().x(), top = near * camera.tangent().y();
        glFrustum(-right, right, -top, top, near, far);
        glMatrixMode(GL_MODELVIEW);
        glLoadIdentity();
        set_light(GL_LIGHT0, -0.55f, 0.65f, 0.52f, 0.75f, 0.7f, 0.62f);
        set_light(GL_LIGHT1, 0.6f, -0.2f, 0.7f, 0.3f, 0.33f, 0.38f);
        Eigen::Isometry3d to_camera = Eigen::Isometry3d::Identity();
        to_camera.linear() = camera.axes().transpose();
        to_camera.translation() = -(camera.axes().transpose() * camera.eye());
        glMultMatrixd(to_camera.data());
        const double distance = camera.project(box.isEmpty() ? Point::Zero() : Point(box.center())).z();
        return distance > 0 ? 0.5 * view.height / (camera.tangent().y() * distance) : 0;
    }

    void draw_mesh() const {
        if (vertices.empty()) return;
        glEnable(GL_LIGHTING);
        glEnable(GL_NORMALIZE);
        glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
        if (paint.sides != pierce::Sides::both) {
            glEnable(GL_CULL_FACE);
            glCullFace(paint.sides == pierce::Sides::back ? GL_FRONT : GL_BACK);
        }
        const auto material = [](GLenum side, const Colour& colour) {
            const float values[] = {shown(colour.x()), shown(colour.y()), shown(colour.z()), 1};
            glMaterialfv(side, GL_AMBIENT_AND_DIFFUSE, values);
        };
        material(GL_FRONT, paint.front);
        material(GL_BACK, paint.back);
        glEnableClientState(GL_VERTEX_ARRAY);
        glEnableClientState(GL_NORMAL_ARRAY);
        glVertexPointer(3, GL_FLOAT, sizeof(Vertex), vertices.front().position);
        glNormalPointer(GL_FLOAT, sizeof(Vertex), vertices.front().normal);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
        glDisableClientState(GL_NORMAL_ARRAY);
        glDisableClientState(GL_VERTEX_ARRAY);
        glDisable(GL_CULL_FACE);
        glDisable(GL_LIGHTING);
    }
};

Window::Window(const std::string& title, const View& view) : impl_(std::make_unique<Impl>()) {
    impl_->view = view;
    const auto give_up = [](const char* what) {
        const char* reason = nullptr;
        glfwGetError(&reason);
        throw std::runtime_error(std::string(what) + (reason ? std::string(": ") + reason : ""));
    };
    if (!glfwInit()) give_up("no window can be opened (--picture needs none)");
    impl_->window = glfwCreateWindow(view.width, view.height, title.c_str(), nullptr, nullptr);
    if (!impl_->window) {
        glfwTerminate();
        give_up("no window can be opened (--picture needs none)");
    }
    glfwMakeContextCurrent(impl_->window);
    glfwSwapInterval(1);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
    ImGui_ImplGlfw_InitForOpenGL(impl_->window, true);
    ImGui_ImplOpenGL2_Init();
}

Window::~Window() {
    ImGui_ImplOpenGL2_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(impl_->window);
    glfwTerminate();
}

bool Window::is_open() const { return !glfwWindowShouldClose(impl_->window); }

void Window::set_mesh(const pierce::TriangleSoup<float>& soup, const Paint& paint) {
    impl_->paint = paint;
    impl_->vertices.clear();
    impl_->box.setEmpty();
    for (const auto& triangle : soup.triangles) {
        const Eigen::Vector3f corners[] = {soup.positions[triangle[0]], soup.positions[triangle[1]],
                                           soup.positions[triangle[2]]};
        const Eigen::Vector3f normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        for (const Eigen::Vector3f& corner : corners) {
            impl_->vertices.push_back({{corner.x(), corner.y(), corner.z()}, {normal.x(), normal.y(), normal.z()}});
            impl_->box.extend(corner.cast<double>());
        }
    }
    // OpenGL's floats and the sliders' have to hold some multiples of it.
    if (!impl_->box.isEmpty() && impl_->box.diagonal().norm() > 1e30)
        throw std::runtime_error("the mesh is too large for a window");
}

void Window::frame(std::span<const Dot> dots, std::span<const Line> lines, const std::function<void()>& panel,
                   Image* screenshot) {
    glfwPollEvents();
    ImGui_ImplOpenGL2_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    impl_->follow_mouse();
    ImGui::SetNextWindowPos({10, 10}, ImGuiCond_Once);
    ImGui::Begin("pierce", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    if (panel) panel();
    ImGui::End();
    ImGui::Render();

    int width = 0, height = 0;
    glfwGetFramebufferSize(impl_->window, &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(0.35f, 0.37f, 0.4f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    const double pixels = impl_->set_camera(width, height);
    impl_->draw_mesh();

    draw_dots(dots, pixels);
    std::vector<Mark> marks;
    for (const bool on_top : {false, true}) {
        marks.clear();
        for (const Line& line : lines)
            if (line.on_top == on_top) {
                marks.push_back(mark(line.from, line.colour));
                marks.push_back(mark(line.to, line.colour));
            }
        if (on_top) glDisable(GL_DEPTH_TEST);
        draw_marks(marks, GL_LINES);
    }
    ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
    if (screenshot) *screenshot = what_is_seen(width, height);
    glfwSwapBuffers(impl_->window);
}

}  // namespace show
