#include "loaded.h"

static void cameras(void **state) {
    (void)state;
    loaded_check_twins(
        HEAD_YAML "camera: {position: [1, 2, 3], look_at: [1, 2, 3]}\n",
        HEAD_XML
        "<Camera><Position x=\"1\" y=\"2\" z=\"3\"/><LookAt x=\"1\" y=\"2\" z=\"3\"/></Camera>" END_XML,
        "E401", "camera 'main' looks at its own position");
    loaded_check(HEAD_YAML "camera: {look_at: [0, 0, 0]}\n", "E401",
                 "'position' is not written; it is 0 0 0");
    loaded_check(HEAD_YAML "camera: {look_at: [0, 0, 1.0e-18]}\n", "", NULL);
    loaded_check_twins(
        HEAD_YAML "camera: {direction: [0, 3, 0], up: [0, -1, 0]}\n",
        HEAD_XML
        "<Camera><Direction x=\"0\" y=\"3\" z=\"0\"/><Up x=\"0\" y=\"-1\" z=\"0\"/></Camera>" END_XML,
        "E402", "'up' of camera 'main' points along the direction of view");
    loaded_check(HEAD_YAML "camera: {direction: [0, 1, 0]}\n", "", NULL); // the default adapts
    loaded_check(HEAD_YAML "camera: {up: [0, 0, 2]}\n", "E402", "the camera looks along 0 0 -1");
    loaded_check(HEAD_YAML "camera: {direction: [0, 1, 0], up: [1.0e-8, 1, 0]}\n", "", NULL);
    loaded_check(HEAD_YAML "camera: {direction: [0, 1, 0], up: [1.0e-10, 1, 0]}\n", "E402", NULL);
    loaded_check(HEAD_YAML "camera: {direction: [0, 1e18, 0], up: [1e18, 0, 0]}\n", "", NULL);
    loaded_check(HEAD_YAML "camera: {direction: [0, 0, 0], up: [0, 0, 0]}\n", "E403 E403",
                 "'direction' of camera 'main' is 0 0 0, which points nowhere");
    loaded_check(HEAD_YAML "camera: {rotation: [0, 0, 0], up: [0, 1, 0]}\n", "E406", "'rotation' is here");
    loaded_check(HEAD_YAML "camera: {rotation: [0, x, 0], look_at: [0, 0, 0]}\n", "E205 E214", NULL);
}

static void lights(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML "lights: [{direction: [0, 0, 0]}]\n",
                       HEAD_XML "<Light><Direction x=\"0\" y=\"0\" z=\"0\"/></Light>" END_XML, "E403",
                       "'direction' of this light is 0 0 0, which points nowhere");
    loaded_check_twins(HEAD_YAML "lights: [{name: sun, direction: [0, -1, 0], falloff: inverse_square}]\n",
                       HEAD_XML "<Light name=\"sun\" falloff=\"inverse_square\"><Direction x=\"0\" y=\"-1\" "
                                "z=\"0\"/></Light>" END_XML,
                       "E407", "light 'sun' has a direction, so its light cannot fall off with distance");
    loaded_check(HEAD_YAML "lights: [{direction: [0, -1, 0], falloff: none}]\n", "", NULL);
    loaded_check(HEAD_YAML "lights: [{position: [0, -1, 0], falloff: inverse_square}]\n", "", NULL);
}

static void bodies(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML
                       "rectangles: [{corner: [0, 0, 0], edge_u: [1, 2, 3], edge_v: [-2, -4, -6]}]\n",
                       HEAD_XML "<Rectangle><Corner x=\"0\" y=\"0\" z=\"0\"/><EdgeU x=\"1\" y=\"2\" "
                                "z=\"3\"/><EdgeV x=\"-2\" y=\"-4\" z=\"-6\"/></Rectangle>" END_XML,
                       "E404", "the edges of this rectangle are parallel, which leaves no area");
    loaded_check(HEAD_YAML "rectangles: [{corner: [0, 0, 0], edge_u: [0, 0, 0], edge_v: [1, 0, 0]}]\n",
                 "E404", "'edge_u' of this rectangle is 0 0 0, which leaves no area");
    loaded_check(HEAD_YAML
                 "rectangles: [{corner: [0, 0, 0], edge_u: [1.0e-18, 0, 0], edge_v: [0, 1.0e-18, 0]}]\n",
                 "", NULL);
    loaded_check(HEAD_YAML "rectangles: [{corner: [1e18, 0, 0], edge_u: [1e17, 0, 0], edge_v: [0, 1, 0]}]\n",
                 "E409", NULL);
    loaded_check(HEAD_YAML "spheres: [{center: [9e17, 0, 0], radius: 2e17}]\n", "E409",
                 "this sphere has a coordinate beyond 1e18");
    loaded_check(HEAD_YAML "spheres: [{center: [9e17, 0, 0], radius: 1e17}]\n", "", NULL);
    loaded_check_twins(HEAD_YAML "models: [{mesh: a.obj, scale: [1, 0, 1]}]\n",
                       HEAD_XML "<Model mesh=\"a.obj\"><Scale x=\"1\" y=\"0\" z=\"1\"/></Model>" END_XML,
                       "E405", "'scale' of this model is 0, which leaves nothing of it");
    loaded_check(HEAD_YAML "models: [{mesh: a.obj, scale: [1, -1, 1]}]\n", "", NULL);
    // What failed before is not judged again.
    loaded_check(HEAD_YAML "rectangles: [{corner: [0, 0, 0], edge_u: [0, x, 0], edge_v: [0, 0, 0]}]\n",
                 "E205 E404", NULL);
    loaded_check(HEAD_YAML "rectangles: [{corner: [0, 0, 0], edge_v: [1, 0, 0]}]\n", "E204", NULL);
}

static void pictures(void **state) {
    (void)state;
    loaded_check_twins(HEAD_YAML "image: {width: 16384, height: 16384, error: 0.1}\n",
                       HEAD_XML "<Image width=\"16384\" height=\"16384\" error=\"0.1\"/>" END_XML, "E408",
                       "the image has 16384 x 16384, that is 268435456 pixels; at most 67108864 are allowed "
                       "where 'error' ends them");
    loaded_check(HEAD_YAML "image: {width: 8192, height: 8192, error: 0.1}\n", "", NULL);
    loaded_check(HEAD_YAML "image: {width: 8193, height: 8192, error: 0.1}\n", "E408", NULL);
    loaded_check(HEAD_YAML "image: {width: 16384, height: 16384}\n", "", NULL);
    loaded_check(HEAD_YAML "image: {width: 99999, height: 16384}\n", "E206", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras),
        cmocka_unit_test(lights),
        cmocka_unit_test(bodies),
        cmocka_unit_test(pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
