use super::{cube, cubes, resolve, with_object};
use crate::mesh::vertex_normals::{NormalSource, NormalWeight};
use crate::mesh::{Material, MeshBuilder, PolygonMesh};
use crate::note::{Level, Note, Notes, SceneKeys};
use crate::picture::Encoding;
use crate::scene::file::Resolved;
use crate::scene::file::SceneFile;
use crate::scene::file::diagnostics::Origin;
use crate::scene::file::value::Data;
use crate::scene::{
    Clipping, Culling, DepthBits, DepthBuffer, DepthSource, HiddenSurfaces, Interpolation, Light,
    Object, PainterKey, Place, Projection, Scene,
};
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};
use std::format;
use std::path::PathBuf;
use std::string::ToString;
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

/// True if two vectors differ only by a few roundings. Coordinates here are below 10, and each
/// comes from fewer than 50 operations with an error of 2^-53 each.
fn near(a: DVec3, b: DVec3) -> bool {
    (a - b).abs().max_element() < 10.0 * 50.0 * f64::EPSILON
}

#[test]
fn defaults() {
    let Resolved { scene, notes, .. } = resolve(&with_object(""));
    assert_eq!(
        (scene.width, scene.height, scene.background),
        (640, 480, [0.0; 3])
    );
    assert_eq!(
        (scene.ambient, scene.hidden_surfaces),
        ([1.0; 3], HiddenSurfaces::default())
    );
    assert_eq!(
        (scene.interpolation, scene.culling),
        (Interpolation::Screen, Culling::Back)
    );
    assert_eq!(scene.encoding, Encoding::Linear);
    assert_eq!(scene.lights.len(), 1);
    let Place::Infinite(direction) = scene.lights[0].place else {
        panic!("{:?}", scene.lights)
    };
    assert!(near(
        direction,
        DVec3::from_array(Scene::DEFAULT_LIGHT).normalize()
    ));
    assert_eq!(scene.lights[0].colour, [1.0; 3]);
    assert_eq!(scene.objects[0].material, Some(Material::default()));
    assert_eq!(scene.objects[0].normals.source, NormalSource::Averaged);
    assert!(near(
        scene.camera.view(),
        DVec3::from_array(Scene::DEFAULT_DIRECTION).normalize()
    ));
    assert_eq!(
        (scene.camera.target, scene.camera.up),
        (DVec3::ZERO, DVec3::Y)
    );
    assert!(notes.is_empty());
}

#[test]
fn every_choice() {
    let text = "interpolation = 'perspective'\ncull = 'front'\nvisibility = 'draw-order'\nambient = [0.5, 0, 1]\n\
                [image]\nwidth = 16384\nheight = 1\nbackground = [0, 0.5, 1]\nencoding = 'srgb'\n";
    let scene = resolve(&with_object(text)).scene;
    assert_eq!(
        (scene.width, scene.height, scene.background),
        (16384, 1, [0.0, 0.5, 1.0])
    );
    assert_eq!(
        (scene.interpolation, scene.culling),
        (Interpolation::Perspective, Culling::Front)
    );
    assert_eq!(
        (scene.encoding, scene.hidden_surfaces, scene.ambient),
        (Encoding::Srgb, HiddenSurfaces::DrawOrder, [0.5, 0.0, 1.0])
    );
    assert_eq!(
        resolve(&with_object("cull = 'none'")).scene.culling,
        Culling::None
    );
    for (words, source) in [
        ("normals = 'given'", NormalSource::Given),
        ("normals = 'averaged'", NormalSource::Averaged),
        ("crease = 30", NormalSource::Crease(30.0)),
    ] {
        assert_eq!(
            resolve(&(with_object("") + words)).scene.objects[0]
                .normals
                .source,
            source
        );
    }
    for (words, weight) in [
        ("", NormalWeight::Uniform),
        ("normals_weight = 'uniform'", NormalWeight::Uniform),
        ("normals_weight = 'area'", NormalWeight::Area),
        ("crease = 30\nnormals_weight = 'angle'", NormalWeight::Angle),
        (
            "normals = 'auto'\nnormals_weight = 'max'",
            NormalWeight::Max,
        ),
    ] {
        let normals = resolve(&(with_object("") + words)).scene.objects[0].normals;
        assert_eq!(normals.weight, weight);
        assert_eq!(
            normals.source == NormalSource::Averaged,
            !words.contains('\n')
        );
    }
}

#[test]
fn the_rest_of_visibility() {
    let of = |text: &str| resolve(&with_object(text)).scene;
    let plain = of("");
    assert_eq!(
        (plain.clipping, plain.two_sided, plain.samples),
        (Clipping::Planes, false, 1)
    );
    let other = of(
        "clipping = 'ndc-cube'\ncull = 'none'\ntwo_sided = true\n[image]\nsamples = 8\nwidth = 2048",
    );
    assert_eq!(
        (other.clipping, other.two_sided, other.samples),
        (Clipping::NdcCube, true, 8)
    );
    assert_eq!(
        of("clipping = 'planes'\ninterpolation = 'perspective'").clipping,
        Clipping::Planes
    );
}

/// Each method for hidden surfaces has settings. A warning names settings of another method.
#[test]
fn every_way_of_hiding_surfaces() {
    let of = |text: &str| resolve(&with_object(text));
    let buffer = |bits, source| HiddenSurfaces::ZBuffer(DepthBuffer { bits, source });
    for (text, expected) in [
        ("visibility = 'z-buffer'", HiddenSurfaces::default()),
        (
            "depth_bits = 16",
            buffer(DepthBits::Sixteen, DepthSource::Interpolated),
        ),
        (
            "depth_bits = 24\ndepth = 'per-sample'",
            buffer(DepthBits::TwentyFour, DepthSource::PerSample),
        ),
        (
            "depth_bits = 32\ndepth = 'interpolated'",
            HiddenSurfaces::default(),
        ),
        (
            "visibility = 'painter'",
            HiddenSurfaces::Painter(PainterKey::Mean),
        ),
        (
            "visibility = 'painter'\npainter_key = 'farthest'",
            HiddenSurfaces::Painter(PainterKey::Farthest),
        ),
    ] {
        let Resolved { scene, notes, .. } = of(text);
        assert_eq!(
            (scene.hidden_surfaces, notes.is_empty()),
            (expected, true),
            "{text}"
        );
    }
    for (text, warning) in [
        (
            "two_sided = true",
            "`two_sided` has no effect with cull = \"back\": polygons seen from behind are left out",
        ),
        (
            "painter_key = 'mean'",
            "`painter_key` has no effect without visibility = \"painter\"",
        ),
        (
            "visibility = 'painter'\ndepth_bits = 16",
            "`depth_bits` has no effect without visibility = \"z-buffer\"",
        ),
        (
            "visibility = 'draw-order'\ndepth = 'per-sample'",
            "`depth` has no effect without visibility = \"z-buffer\"",
        ),
    ] {
        assert_eq!(of(text).notes.to_string(), warning);
    }
}

/// Returns the unit sphere of 72 × 36 segments with its axis along z. Another program computed the
/// values in `fit_rule` from it.
fn sphere() -> PolygonMesh {
    let mut positions = vec![Vec3::Z];
    for ring in 1..36 {
        for segment in 0..72 {
            let (theta, phi) = (PI * f64::from(ring) / 36.0, TAU * f64::from(segment) / 72.0);
            let p = DVec3::new(
                theta.sin() * phi.cos(),
                theta.sin() * phi.sin(),
                theta.cos(),
            );
            positions.push(p.as_vec3());
        }
    }
    positions.push(Vec3::NEG_Z);
    let mut mesh = MeshBuilder::new(positions.clone());
    // A fit does not depend on the polygons that use the positions.
    for i in 2..positions.len() as u32 {
        mesh.polygon(&[i - 2, i - 1, i]);
    }
    mesh.finish().expect("valid")
}

#[test]
fn fit_rule() {
    // Positions are rounded to 2^-24, and a distance is at most 7 of them: below 1e-6. Nine printed
    // digits are just as exact.
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let sphere = |text: &str| {
        let file = SceneFile::parse(&with_object(text), "scene.toml").expect("valid");
        file.resolve(|_, _| Ok((Arc::new(sphere()), Notes::default())))
            .expect("valid")
            .scene
            .camera
    };
    for text in [
        "",
        "[camera]\nfit = 0.8\neye = [1.5, 1.3, 3]\ntarget = [1, 1, 2]",
    ] {
        let camera = sphere(text);
        let Projection::Orthographic { half_height } = camera.projection else {
            panic!("{camera:?}")
        };
        assert!(near(half_height, 1.24890709), "{half_height}");
        let eye = camera.eye;
        assert!(
            near(eye.x, 2.99252801) && near(eye.y, 1.7955168) && near(eye.z, 5.98505602),
            "{eye}"
        );
        assert!(
            near(camera.near, 5.82825258) && near(camera.far, 8.02815388),
            "{camera:?}"
        );
        assert_eq!(camera.target, DVec3::ZERO);
    }
    let camera = sphere("[camera]\nfovy = 40");
    assert_eq!(camera.projection, Projection::Perspective { fovy: 40.0 });
    let eye = camera.eye;
    assert!(
        near(eye.x, 1.54467031) && near(eye.y, 0.926802184) && near(eye.z, 3.08934061),
        "{eye}"
    );
    assert!(
        near(camera.near, 2.47621966) && near(camera.far, 4.67612096),
        "{camera:?}"
    );
}

/// A far plane at infinity stands for the farthest one, also where it is printed.
#[test]
fn a_far_plane_at_infinity() {
    let far = |far: &str| {
        let camera = format!("[camera]\neye = [0, 0, 5]\nfovy = 40\nnear = 1\nfar = {far}");
        resolve(&with_object(&camera)).scene.camera.far
    };
    assert_eq!([far("inf"), far("+inf"), far("1e20")], [1e20; 3]);
}

#[test]
fn camera_at_a_given_place() {
    let camera = resolve(&with_object(
        "[camera]\neye = [0, 0, 5]\nhalf_height = 2\nnear = -3\nfar = 70",
    ))
    .scene
    .camera;
    assert_eq!(
        (camera.eye, camera.target, camera.up),
        (DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, DVec3::Y)
    );
    assert_eq!(
        (camera.projection, camera.near, camera.far),
        (Projection::Orthographic { half_height: 2.0 }, -3.0, 70.0)
    );
    let camera = resolve(&with_object(
        "[camera]\neye = [0, 3, 5]\ntarget = [0, 3, 0]\nup = [2, 0, 0]\nfovy = 90",
    ))
    .scene
    .camera;
    assert_eq!(
        (camera.projection, camera.up),
        (Projection::Perspective { fovy: 90.0 }, DVec3::X)
    );
    // The cube lies from 4 to 6 in front of the eye, and 5 % of 2 is added.
    assert!(
        near(
            DVec3::new(camera.near, camera.far, 0.0),
            DVec3::new(3.9, 6.1, 0.0)
        ),
        "{camera:?}"
    );
    // Without a projection the cube fills 0.8 of the picture: in height here, or in width if that
    // is smaller.
    for (size, half_height) in [("width = 640", 1.0 / 0.8), ("width = 240", 2.0 / 0.8)] {
        let text = format!("[image]\n{size}\n[camera]\neye = [0, 0, 5]");
        let Projection::Orthographic { half_height: found } =
            resolve(&with_object(&text)).scene.camera.projection
        else {
            panic!("perspective")
        };
        assert!(
            near(DVec3::splat(found), DVec3::splat(half_height)),
            "{found}"
        );
    }
    let away = resolve(&with_object(
        "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\nfovy = 30",
    ));
    assert_eq!(away.notes.to_string(), "nothing lies in front of the eye");
}

#[test]
fn camera_directions() {
    for (text, direction, up) in [
        ("azimuth = 90", DVec3::X, DVec3::Y),
        ("elevation = 90", DVec3::Y, -DVec3::Z),
        ("elevation = -90", -DVec3::Y, DVec3::Z),
        ("elevation = 90\nazimuth = 90", DVec3::Y, -DVec3::X),
        (
            "elevation = 30\nazimuth = 180",
            DVec3::new(0.0, 0.5, -0.75f64.sqrt()),
            DVec3::Y,
        ),
        ("direction = [0, 2e200, 0]", DVec3::Y, -DVec3::Z),
        ("direction = [3e-200, 0, 0]", DVec3::X, DVec3::Y),
        ("direction = [1, 0, 0]\nup = [0, 0, 7]", DVec3::X, DVec3::Z),
    ] {
        let camera = resolve(&with_object(&format!("[camera]\n{text}")))
            .scene
            .camera;
        assert!(
            near(camera.view(), direction) && near(camera.up, up),
            "{text}: {camera:?}"
        );
    }
    let camera = resolve(&with_object("[camera]\nhalf_height = 7\nazimuth = 0"))
        .scene
        .camera;
    assert_eq!(
        camera.projection,
        Projection::Orthographic { half_height: 7.0 }
    );
}

#[test]
fn lights() {
    let text = "[[light]]\ndirection = [0, 0, 4]\n[[light]]\ndirection = [3, 4, 0]\ncolour = [1, 0.5, 0]\nintensity = 0.5\n";
    let lights = resolve(&with_object(text)).scene.lights;
    assert_eq!(lights[0], Light::directional(DVec3::Z, [1.0; 3]));
    assert_eq!(lights[1].colour, [0.5, 0.25, 0.0]);
    let Place::Infinite(direction) = lights[1].place else {
        panic!("{lights:?}")
    };
    assert!(near(direction, DVec3::new(0.6, 0.8, 0.0)));
    assert!(resolve(&with_object("light = []")).scene.lights.is_empty());
}

/// Returns a point transformed by the only object of a scene.
fn moved(keys: &str, point: [f64; 3]) -> DVec3 {
    resolve(&(with_object("") + keys)).scene.objects[0]
        .transform
        .transform_point3(DVec3::from_array(point))
}

#[test]
fn transforms() {
    assert_eq!(moved("", [1.0, 2.0, 3.0]), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(
        moved("scale = [2, -1, 1]\ntranslate = [0, 0, 5]", [1.0, 2.0, 3.0]),
        DVec3::new(2.0, -2.0, 8.0)
    );
    // Scaled first (x to 2), then rotated (x to y), then translated.
    let all =
        "translate = [10, 0, 0]\nrotate = { axis = [0, 0, 9], angle = 90 }\nscale = [2, 1, 1]";
    assert!(near(
        moved(all, [1.0, 0.0, 0.0]),
        DVec3::new(10.0, 2.0, 0.0)
    ));
    // First around z (x to y), then around x (y to z).
    let turns = "rotate = [{ axis = [0, 0, 1], angle = 90 }, { axis = [1, 0, 0], angle = 90 }]";
    assert!(near(moved(turns, [1.0, 0.0, 0.0]), DVec3::Z));
    assert_eq!(moved("rotate = []", [1.0, 0.0, 0.0]), DVec3::X);
    let matrix = "matrix = [[0, 0, 2, 7], [1, 0, 0, 8], [0, 1, 0, 9]]";
    assert_eq!(moved(matrix, [1.0, 2.0, 3.0]), DVec3::new(13.0, 9.0, 11.0));
    // Strong shear is not degenerate, and neither is a small scale.
    assert_eq!(
        moved(
            "matrix = [[1, 1e6, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]",
            [0.0, 1.0, 0.0]
        )
        .x,
        1e6
    );
    assert_eq!(moved("scale = 1e-9", [1.0, 0.0, 0.0]).x, 1e-9);
}

/// Returns a cube whose first polygon has a material and whose others have none.
fn painted() -> PolygonMesh {
    let plain = cube();
    let mut mesh = MeshBuilder::new(plain.positions().to_vec());
    for polygon in plain.polygons() {
        mesh.polygon(polygon);
    }
    let paint = Material {
        shininess: 5.0,
        ..Material::default()
    };
    mesh.materials(
        vec![paint],
        vec![0, u32::MAX, u32::MAX, u32::MAX, u32::MAX, u32::MAX],
    );
    mesh.finish().expect("valid")
}

/// Returns the shininess of polygon `p` as the engine sees it.
fn shininess(object: &Object, p: usize) -> f32 {
    match (object.material, object.mesh.polygon_material(p)) {
        (Some(material), _) => material.shininess,
        (None, Some(own)) => object.mesh.materials()[own].shininess,
        (None, None) => Material::default().shininess,
    }
}

#[test]
fn materials() {
    let object = |text: &str| {
        let file = SceneFile::parse(text, "scene.toml").expect("valid");
        file.resolve(|_, _| Ok((Arc::new(painted()), Notes::default())))
            .expect("valid")
            .scene
            .objects
            .remove(0)
    };
    let default = Material::default().shininess;
    for (scene, own, first, second) in [
        ("", "", 5.0, default),
        ("[material]\nshininess = 7", "", 5.0, 7.0),
        (
            "[material]\nshininess = 7",
            "[object.material]\nshininess = 9",
            9.0,
            9.0,
        ),
        (
            "[material]\nshininess = 7",
            "[object.material]\nka = 0.5",
            7.0,
            7.0,
        ),
        ("", "[object.material]", default, default),
    ] {
        let object = object(&(with_object(scene) + own));
        assert_eq!(
            (shininess(&object, 0), shininess(&object, 1)),
            (first, second),
            "{scene} {own}"
        );
        // Materials change no other setting.
        assert_eq!(
            (object.mesh.positions(), object.mesh.corners()),
            (cube().positions(), cube().corners())
        );
    }
    let text =
        with_object("[material]\nka = 0.1\nkd = [0.25, 0.5, 0.75]\nks = 0.5\nshininess = 200");
    let material = resolve(&text).scene.objects[0]
        .material
        .expect("that of the scene");
    let expected = Material {
        ambient: [0.1; 3],
        diffuse: [0.25, 0.5, 0.75],
        specular: [0.5; 3],
        shininess: 200.0,
    };
    assert_eq!(material, expected);
}

#[test]
fn each_mesh_is_loaded_once_from_its_folder() {
    let text =
        "[[object]]\nmesh = 'a.obj'\n[[object]]\nmesh = 'b.obj'\n[[object]]\nmesh = 'a.obj'\n";
    let mut file = SceneFile::parse(text, "some/where/scene.toml").expect("valid");
    let mut asked = Vec::new();
    let mut load = |spec: &str, folder: &std::path::Path| {
        asked.push((spec.to_string(), PathBuf::from(folder)));
        let odd = Note::warning("odd", format!("odd {spec}"));
        Ok((Arc::new(cube()), Notes::from_iter([odd])))
    };
    let resolved = file.resolve(&mut load).expect("valid");
    assert_eq!(resolved.notes.to_string(), "odd a.obj\nodd b.obj");
    assert!(Arc::ptr_eq(
        &resolved.scene.objects[0].mesh,
        &resolved.scene.objects[2].mesh
    ));
    // A mesh named by a flag is relative to the working directory, not to the scene.
    let flag = Origin::Flag("MESH".into());
    file.objects_mut()[2].set("mesh", Data::Text("a.obj".into()), flag);
    asked.clear();
    let mut load = |spec: &str, folder: &std::path::Path| {
        asked.push((spec.to_string(), PathBuf::from(folder)));
        Ok((Arc::new(cube()), Notes::default()))
    };
    file.resolve(&mut load).expect("valid");
    let there = PathBuf::from("some/where");
    assert_eq!(
        asked,
        [
            ("a.obj".into(), there.clone()),
            ("b.obj".into(), there),
            ("a.obj".into(), PathBuf::new())
        ]
    );
}

/// Returns the camera of `below` overlaid with the flags `over`.
fn overlaid(below: &str, over: &str) -> crate::scene::Camera {
    let mut file =
        SceneFile::parse(&with_object(&format!("[camera]\n{below}")), "scene.toml").expect("valid");
    let over = SceneFile::parse(&format!("[camera]\n{over}"), "flags").expect("valid");
    file.overlay(over.table.clone());
    assert_eq!(file.path(), Some(std::path::Path::new("scene.toml")));
    file.resolve(cubes)
        .unwrap_or_else(|error| panic!("{below} under {}: {error}", over.to_toml()))
        .scene
        .camera
}

#[test]
fn flags_over_a_file() {
    let mut file = SceneFile::parse(
        &with_object("ambient = 0.5\ncull = 'none'\n[material]\nka = 1\nkd = 1"),
        "a",
    )
    .expect("valid");
    let over = "ambient = 0.25\nvisibility = 'draw-order'\n[material]\nkd = 0.5\n[[light]]\ndirection = [1, 0, 0]";
    file.overlay(SceneFile::parse(over, "b").expect("valid").table);
    let merged = "ambient = 0.25\ncull = 'none'\nvisibility = 'draw-order'\n[material]\nka = 1\nkd = 0.5\n[[light]]\ndirection = [1, 0, 0]";
    assert_eq!(
        file,
        SceneFile::parse(&with_object(merged), "c").expect("valid")
    );

    // Flags override the file. Empty flags change nothing.
    let all = |n: u32, cull: &str, space: &str, encoding: &str| {
        let material = format!("ka = {n}\nkd = {n}\nks = {n}\nshininess = {n}");
        format!(
            "title = '{n}'\ndescription = '{n}'\nambient = {n}\ncull = '{cull}'\ninterpolation = '{space}'\n\
             visibility = '{}'\ndepth_bits = {n}\ndepth = '{}'\npainter_key = '{}'\nclipping = '{}'\ntwo_sided = {}\n[image]\nsamples = {n}\nwidth = {n}\nheight = {n}\nbackground = {n}\nencoding = '{encoding}'\n\
             [material]\n{material}\n[[light]]\ndirection = [{n}, 0, 0]\n[[object]]\nmesh = '{n}'",
            if n == 1 { "z-buffer" } else { "painter" },
            if n == 1 { "interpolated" } else { "per-sample" },
            if n == 1 { "mean" } else { "farthest" },
            if n == 1 { "planes" } else { "ndc-cube" },
            n == 1,
        )
    };
    let [below, over] = [
        all(1, "back", "screen", "linear"),
        all(2, "front", "perspective", "srgb"),
    ]
    .map(|text| SceneFile::parse(&text, "all").expect("valid"));
    let mut merged = below.clone();
    merged.overlay(SceneFile::default().table);
    assert_eq!(merged, below);
    merged.overlay(over.table.clone());
    assert_eq!(merged, over);
}

#[test]
fn camera_flags_over_a_file() {
    let plain = resolve(&with_object("")).scene.camera;
    assert_eq!(overlaid("half_height = 3", "fit = 0.8"), plain);
    assert_eq!(
        overlaid("eye = [0.5, 0.3, 1]\nnear = 3\nfar = 4", "fit = 0.8"),
        plain
    );
    assert_eq!(
        overlaid("fovy = 30", "half_height = 3").projection,
        Projection::Orthographic { half_height: 3.0 }
    );
    assert_eq!(
        overlaid("fit = 0.5\nfovy = 30", "fovy = 20").projection,
        Projection::Perspective { fovy: 20.0 }
    );
    let turned = overlaid(
        "eye = [0, 0, 5]\ntarget = [1, 0, 0]\nhalf_height = 2",
        "azimuth = 90",
    );
    assert!(near(turned.view(), DVec3::X));
    assert_eq!(
        turned.projection,
        Projection::Orthographic { half_height: 2.0 }
    );
    assert!(near(
        overlaid("direction = [0, 0, 1]", "elevation = 90").view(),
        DVec3::Y
    ));
    assert!(near(
        overlaid("azimuth = 90\nelevation = 10", "elevation = 0").view(),
        DVec3::X
    ));
    assert!(near(
        overlaid("azimuth = 90", "direction = [0, 0, 1]").view(),
        DVec3::Z
    ));
    assert_eq!(
        overlaid("fit = 0.5\nazimuth = 90", "eye = [0, 0, 9]").eye,
        DVec3::new(0.0, 0.0, 9.0)
    );
    let zoomed = overlaid(
        "fit = 0.5\neye = [9, 0, 9]\ntarget = [9, 0, 0]",
        "half_height = 3",
    );
    assert!(near(zoomed.view(), DVec3::Z) && near(zoomed.target, DVec3::ZERO));
    assert_eq!(
        zoomed.projection,
        Projection::Orthographic { half_height: 3.0 }
    );
}

/// The name of an axis turns everything that the program chooses; three numbers turn only the
/// picture.
#[test]
fn up_by_name_turns_default_view_and_light_and_up_by_numbers_does_not() {
    let at_rest = resolve(&with_object("")).scene;
    let toward = |scene: &Scene| match scene.lights[0].place {
        Place::Infinite(toward) => toward,
        Place::Local(at) => panic!("{at}"),
    };
    let unit = DVec3::from_array(Scene::DEFAULT_DIRECTION).normalize();
    for (name, up) in [
        ("x", DVec3::X),
        ("y", DVec3::Y),
        ("z", DVec3::Z),
        ("-x", -DVec3::X),
        ("-y", -DVec3::Y),
        ("-z", -DVec3::Z),
    ] {
        let turned = resolve(&with_object(&format!("[camera]\nup = '{name}'"))).scene;
        let camera = turned.camera;
        assert_eq!(camera.up, up);
        assert!((camera.view().dot(up) - unit.y).abs() < 1e-15, "{name}");
        // Light and view turn together: each keeps its place relative to the other and to up.
        let angle = |scene: &Scene| {
            let [view, toward] = [scene.camera.view(), toward(scene)];
            [
                view.dot(toward),
                scene.camera.up.dot(toward),
                scene.camera.up.cross(view).dot(toward),
            ]
        };
        for (a, b) in angle(&turned).into_iter().zip(angle(&at_rest)) {
            assert!((a - b).abs() < 1e-15, "{name}: {a} {b}");
        }
        // A turntable turns around it, also when seen from above.
        for (view, expected) in [
            ("azimuth = 0\nelevation = 90", up),
            ("elevation = -90", -up),
        ] {
            let text = with_object(&format!("[camera]\nup = '{name}'\n{view}"));
            let camera = resolve(&text).scene.camera;
            assert!(near(camera.view(), expected), "{name} {view}: {camera:?}");
            assert!(camera.axes().iter().all(|axis| axis.is_finite()));
        }
        let [x, y, z] = up.to_array();
        let numbers = format!("[camera]\nup = [{x}, {y}, {z}]");
        let told = resolve(&with_object(&numbers)).scene;
        assert_eq!((told.camera.up, toward(&told)), (up, toward(&at_rest)));
        assert!(near(told.camera.view(), at_rest.camera.view()));
    }
    // What a scene states is left alone.
    let stated = "[camera]\nup = 'z'\ndirection = [1, 1, 1]\n[[light]]\ndirection = [0, 1, 0]";
    let stated = resolve(&with_object(stated)).scene;
    assert!(near(stated.camera.view(), DVec3::ONE.normalize()));
    assert_eq!(toward(&stated), DVec3::Y);
}

#[test]
fn positions_that_are_nearly_one_are_welded_where_an_object_asks_for_it() {
    let mut apart = MeshBuilder::new(vec![
        Vec3::ZERO,
        Vec3::X,
        Vec3::Y,
        Vec3::new(1.0 + 1e-5, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 1e-5),
        Vec3::new(1.0, 1.0, 0.5),
    ]);
    apart.polygon(&[0, 1, 2]).polygon(&[3, 5, 4]);
    let apart = Arc::new(apart.finish().expect("a mesh"));
    let text = "[[object]]\nmesh = 'a.obj'\nweld = 1e-4\n[[object]]\nmesh = 'a.obj'\n\
                [[object]]\nmesh = 'a.obj'\nweld = 1e-6\n[[object]]\nmesh = 'a.obj'\nweld = 1e-4\n";
    let file = SceneFile::parse(text, "scene.toml").expect("valid");
    let load = |_: &str, _: &std::path::Path| Ok((apart.clone(), Notes::default()));
    let scene = file.resolve(load).expect("valid").scene;
    let [welded, same, other, again] = [0, 1, 2, 3].map(|i| &scene.objects[i].mesh);
    assert_eq!(welded.positions()[3..5], apart.positions()[1..3]);
    assert_eq!(welded.positions()[5], apart.positions()[5]);
    assert_eq!(same.positions(), apart.positions());
    assert_eq!(other.positions(), apart.positions());
    assert!(Arc::ptr_eq(welded, again), "welded once");
}

/// Coefficients above 1 are reported if something is drawn with them, under the user's name for
/// them.
#[test]
fn coefficients_over_one_are_told_where_they_are_drawn() {
    let told = |text: &str| resolve(text).notes.texts(Level::Warning, &SceneKeys);
    let starts = |text: &str, name: &str| {
        let warnings = told(text);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(
            warnings[0].starts_with(&format!("`{name}` is 255:")),
            "{warnings:?}"
        );
    };
    starts(&with_object("[material]\nkd = [255, 0, 0]"), "material.kd");
    let own = "[[object]]\nmesh = 'builtin:cube'\nmaterial = { KEYS }\n";
    let own = |keys: &str| own.replace("KEYS", keys);
    starts(&own("ks = 255"), "object.material.ks");
    // Each object has its own. Objects that leave a coefficient open show the scene's.
    let scene = "[material]\nka = 255\n";
    starts(&format!("{scene}{}", own("kd = 0.5")), "material.ka");
    assert!(told(&format!("{scene}{}", own("ka = 1"))).is_empty());
    assert!(told(&with_object("[material]\nka = 1\nkd = 1\nks = 1")).is_empty());
}
