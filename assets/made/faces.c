#include "assets/made/made.h"

#include "assets/made/fault.h"
#include "assets/made/shell.h"

static bool check_vertices(const struct made_faces *faces, struct made_fault *fault) {
    for (uint32_t i = 0; i < faces->vertex_count; i++) {
        const vec3 at = faces->vertices[i];
        const double most = MESH_COORDINATE_MAX;
        if (fabs(at.x) <= most && fabs(at.y) <= most && fabs(at.z) <= most)
            continue;
        fault->points[0] = i;
        return made_fail(fault, MADE_NUMBER, "vertex %u is not three numbers up to 1e18", i + 1);
    }
    return true;
}

static bool check_coordinates(const struct made_faces *faces, struct made_fault *fault) {
    if (!faces->coordinates)
        return true;
    if (faces->coordinate_count != faces->vertex_count && faces->coordinate_count != faces->corner_count)
        return made_fail(fault, MADE_COORDINATES,
                         "there are %u texture coordinates, for %u vertices and %u corners of faces",
                         faces->coordinate_count, faces->vertex_count, faces->corner_count);
    for (uint32_t i = 0; i < faces->coordinate_count; i++) {
        if (isfinite(faces->coordinates[i].u) && isfinite(faces->coordinates[i].v))
            continue;
        fault->points[0] = i;
        return made_fail(fault, MADE_NUMBER, "texture coordinate %u is not two numbers", i + 1);
    }
    return true;
}

static uint32_t end_of(const struct made_faces *faces, uint32_t face) {
    return face + 1 < faces->face_count ? faces->firsts[face + 1] : faces->corner_count;
}

static bool check_face(const struct made_faces *faces, uint32_t face, struct made_fault *fault) {
    const uint32_t first = faces->firsts[face], end = end_of(faces, face);
    fault->outlines[0] = face;
    if (end > faces->corner_count || end < first || end - first < 3)
        return made_fail(fault, MADE_CORNERS_FEW, "face %u has fewer than 3 corners", face + 1);
    for (uint32_t i = first; i < end; i++) {
        if (faces->corners[i] < faces->vertex_count)
            continue;
        fault->points[0] = i - first;
        return made_fail(fault, MADE_INDEX, "corner %u of face %u is vertex %u, and there are %u",
                         i - first + 1, face + 1, faces->corners[i], faces->vertex_count);
    }
    fault->outlines[0] = IR_NO_INDEX;
    return true;
}

static bool check(const struct made_faces *faces, struct made_fault *fault) {
    if (faces->face_count == 0 || faces->firsts[0] != 0)
        return made_fail(fault, MADE_EMPTY, "there are no faces");
    if (!check_vertices(faces, fault) || !check_coordinates(faces, fault))
        return false;
    for (uint32_t i = 0; i < faces->face_count; i++)
        if (!check_face(faces, i, fault))
            return false;
    return true;
}

static void add_face(struct shell *shell, const struct made_faces *faces, uint32_t face,
                     struct shell_corner *corners) {
    const bool by_vertex = faces->coordinate_count == faces->vertex_count;
    uint32_t count = 0;
    for (uint32_t i = faces->firsts[face]; i < end_of(faces, face); i++) {
        const uint32_t vertex = faces->corners[i];
        const uint32_t coordinate = !faces->coordinates ? IR_NO_INDEX : by_vertex ? vertex : i;
        corners[count++] = (struct shell_corner){vertex, IR_NO_INDEX, coordinate};
    }
    shell_face(shell, corners, count);
}

bool made_build_faces(const struct made_faces *faces, const struct made_to *to, struct made *out) {
    made_begin(out);
    struct shell shell;
    if (!check(faces, &out->fault) ||
        !made_count(out, to, faces->corner_count - 2 * (uint64_t)faces->face_count))
        return false;
    shell_begin(&shell, to, out, faces->face_count, faces->corner_count);
    for (uint32_t i = 0; i < faces->vertex_count; i++)
        shell_vertex(&shell, faces->vertices[i]);
    for (uint32_t i = 0; faces->coordinates && i < faces->coordinate_count; i++)
        shell_coordinate(&shell, faces->coordinates[i].u, faces->coordinates[i].v);
    struct shell_corner *corners = ARENA_ARRAY(to->arena, struct shell_corner, faces->corner_count);
    for (uint32_t i = 0; i < faces->face_count; i++)
        add_face(&shell, faces, i, corners);
    shell_end(&shell);
    return true;
}
