#include "assets/mesh_losses.h"
#include "diag/codes/file.h"

// As a share of a face's size: a quadrilateral bent by more than some twenty degrees.
#define BEND_PLAIN 0.05

static const char *plural(uint32_t count) {
    return count == 1 ? "" : "s";
}

static void report_parts(struct asset_file *file, const struct mesh *mesh) {
    const struct mesh_loss_count *lost = &mesh->losses[MESH_LOSS_NOT_FACES];
    struct diag_sink *sink = file->input->sink;
    if (lost->count &&
        asset_report_line(file, DIAG_MESH_DROPPED, lost->line, "%u point%s, line%s or curve%s not drawn",
                          lost->count, plural(lost->count), plural(lost->count),
                          lost->count == 1 ? " is" : "s are"))
        diag_help(sink, "export them as faces, or remove them");
    lost = &mesh->losses[MESH_LOSS_COLORS];
    if (lost->count &&
        asset_report_line(file, DIAG_MESH_DROPPED, lost->line, "the colour%s of %u %s not drawn",
                          plural(lost->count), lost->count, lost->count == 1 ? "vertex is" : "vertices are"))
        diag_help(sink, "a body has the colours of its materials: give the model a 'material'");
    lost = &mesh->losses[MESH_LOSS_IMAGES];
    if (lost->count &&
        asset_report_line(file, DIAG_MESH_DROPPED, lost->line, "the image%s of %u 'usemap' %s not drawn",
                          plural(lost->count), lost->count, lost->count == 1 ? "line is" : "lines are"))
        diag_help(sink, "the surfaces of bodies have no images: give the model a 'material'");
    lost = &mesh->losses[MESH_LOSS_REST];
    if (lost->count &&
        asset_report_line(file, DIAG_MESH_DROPPED, lost->line, "%u byte%s after the last face %s not read",
                          lost->count, plural(lost->count), lost->count == 1 ? "is" : "are"))
        diag_help(sink, "the file may be damaged, or two files in one: export it again");
    lost = &mesh->losses[MESH_LOSS_SCANNED];
    if (lost->count)
        asset_report_line(file, DIAG_MESH_COLORS, lost->line,
                          "the mesh has colours of its own, which are not used; bodies have the colours of "
                          "their materials");
}

diag_code mesh_losses_bend(const struct mesh *mesh) {
    return mesh->bent_most > BEND_PLAIN ? DIAG_MESH_BENT : DIAG_MESH_CURVED;
}

void mesh_losses_report(struct asset_file *file, const struct mesh *mesh) {
    report_parts(file, mesh);
    const struct mesh_loss_count *bent = &mesh->losses[MESH_LOSS_BENT];
    if (bent->count &&
        asset_report_line(file, mesh_losses_bend(mesh), bent->line,
                          "%u of the mesh's %u faces %s not flat: corners are off the plane by up to "
                          "%.2g %% of the face's size",
                          bent->count, mesh->face_count, bent->count == 1 ? "is" : "are",
                          100 * mesh->bent_most))
        diag_help(file->input->sink, "glint draws triangles: export the mesh as triangles to choose them");
}

void mesh_losses_report_normals(struct asset_file *file, const struct mesh *mesh) {
    const struct mesh_loss_count *lost = &mesh->losses[MESH_LOSS_NORMALS];
    if (lost->count && asset_report_line(file, DIAG_NORMAL_ZERO, lost->line,
                                         "%u corner%s of faces %s a normal of length 0; a computed one is "
                                         "used there",
                                         lost->count, plural(lost->count), lost->count == 1 ? "has" : "have"))
        diag_help(file->input->sink, "recompute the normals in a modelling program, or remove them");
}
