//! The default scene around one mesh.

use super::direction::unit;
use super::{Camera, Culling, Fit, Light, Object, Projection, Scene};
use crate::mesh::winding::WindingDoubts;
use crate::mesh::{Material, PolygonMesh};
use alloc::vec;
use glam::DVec3;

impl Scene {
    /// The default width and height of a picture.
    pub const DEFAULT_SIZE: (u32, u32) = (640, 480);
    /// The default fraction of the picture that objects fill.
    pub const DEFAULT_FIT: f64 = 0.8;
    /// The default direction from the objects toward the eye: a three-quarter view.
    pub const DEFAULT_DIRECTION: [f64; 3] = [0.5, 0.3, 1.0];
    /// The default direction toward the light, for scenes that state none.
    pub const DEFAULT_LIGHT: [f64; 3] = [0.4, 0.7, 0.9];

    /// Makes a scene that shows `mesh`: an orthographic three-quarter view fitted around it, one
    /// white light, and the default material for polygons without one.
    ///
    /// Vertex normals are averaged (L21 3.1). A mesh that was read from a file keeps its own
    /// normals instead, or averages them by angle ([`PolygonMesh::normal_rule`]). Back faces are
    /// culled. If a mesh from a file is open, wound inconsistently, or wound against its own
    /// normals, it is drawn and lit on both sides.
    ///
    /// If the mesh has vertex colours, they multiply the ambient and diffuse coefficients, and the
    /// default material is then grey.
    ///
    /// All fields can be changed afterwards. A mesh without polygons makes an empty picture.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    ///
    /// let mut scene = Scene::of_mesh(builtin("teapot?res=4")?);
    /// (scene.width, scene.height) = (320, 240);
    /// scene.lights.clear(); // ambient light only
    /// assert_eq!(scene.frame()?.light_count(), 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_mesh(mesh: PolygonMesh) -> Scene {
        let (width, height) = Scene::DEFAULT_SIZE;
        let fit = Fit {
            direction: unit(DVec3::from_array(Scene::DEFAULT_DIRECTION)),
            up: DVec3::Y,
            fraction: Scene::DEFAULT_FIT,
            fovy: None,
            aspect: f64::from(width) / f64::from(height),
        };
        let corners = mesh
            .corners()
            .iter()
            .map(|&corner| mesh.origin() + mesh.positions()[corner as usize].as_dvec3());
        // Without a polygon there is nothing to see, and any camera will do.
        let camera = Camera::fit(corners, &fit).unwrap_or(Camera {
            eye: fit.direction,
            target: DVec3::ZERO,
            up: fit.up,
            projection: Projection::Orthographic { half_height: 1.0 },
            near: 0.0,
            far: 2.0,
        });
        let own = mesh.materials().is_empty().then(|| {
            if mesh.has_lit_colours() {
                Material::NEUTRAL
            } else {
                Material::default()
            }
        });
        let two_sided = mesh.was_read() && WindingDoubts::of(&mesh).any();
        Scene {
            width,
            height,
            lights: vec![Light::directional(
                unit(DVec3::from_array(Scene::DEFAULT_LIGHT)),
                [1.0; 3],
            )],
            objects: vec![Object {
                material: own,
                ..Object::new(mesh)
            }],
            culling: if two_sided {
                Culling::None
            } else {
                Culling::Back
            },
            two_sided,
            colours: true,
            ..Scene::new(camera)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    #[cfg(feature = "io")]
    use crate::{
        mesh::builtin::builtin,
        raster::{Plan, Renderer},
        scene::file::SceneFile,
        shading::{METHODS, MethodRow},
    };
    use alloc::vec::Vec;

    #[cfg(feature = "io")]
    #[test]
    fn a_mesh_gets_the_frame_that_its_scene_file_gives() {
        for spec in [
            "teapot?res=4",
            "gear",
            "sphere?rings=6&segments=8",
            "terrain?segments=8&rows=8&colours=true",
        ] {
            let mesh = builtin(spec).unwrap();
            let from_file = SceneFile::for_mesh(std::format!("builtin:{spec}"));
            let from_file = from_file
                .resolve(|_, _| Ok((mesh.clone().into(), Default::default())))
                .unwrap();
            let (a, b) = (
                Scene::of_mesh(mesh).frame().unwrap(),
                from_file.scene.frame().unwrap(),
            );
            assert_eq!(std::format!("{a:?}"), std::format!("{b:?}"), "{spec}");
        }
    }

    #[cfg(feature = "io")]
    #[test]
    fn polygons_without_a_material_look_the_same_too() {
        let mut builder = MeshBuilder::new(builtin("gear").unwrap().positions().to_vec());
        let gear = builtin("gear").unwrap();
        gear.polygons().for_each(|polygon| {
            builder.polygon(polygon);
        });
        let blue = Material {
            diffuse: [0.1, 0.2, 0.9],
            ..Material::default()
        };
        let none = u32::MAX;
        builder.materials(
            vec![blue],
            (0..gear.polygon_count())
                .map(|p| if p % 2 == 0 { 0 } else { none })
                .collect(),
        );
        let mesh = builder.finish().unwrap();
        let from_file = SceneFile::for_mesh("builtin:gear");
        let from_file = from_file
            .resolve(|_, _| Ok((mesh.clone().into(), Default::default())))
            .unwrap();
        let (a, b) = (
            Scene::of_mesh(mesh).frame().unwrap(),
            from_file.scene.frame().unwrap(),
        );
        let is_for = |method: &&'static MethodRow| {
            let plan = method.variant().plan(&a, Renderer::LECTURE);
            !matches!(plan, Plan::Refused(_))
        };
        for method in METHODS.iter().filter(is_for) {
            assert_eq!(
                method.variant().render(&a).expect("a method for the frame"),
                method.variant().render(&b).expect("a method for the frame"),
                "{method:?}"
            );
        }
    }

    #[cfg(feature = "io")]
    #[test]
    fn a_mesh_file_gets_its_own_normals_or_averages_by_angle_through_either_door() {
        use crate::mesh::read::parse_mesh;
        use crate::mesh::vertex_normals::{NormalRule, NormalSource, NormalWeight};
        let corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
        let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
        for faces in [
            "f 1 2 4\nf 1 4 3\n",
            "vn 1 0 0\nf 1//1 2//1 4//1\nf 1 4 3\n",
        ] {
            let text = std::format!("{corner}{faces}");
            let mesh = parse_mesh("t.obj", text.as_bytes(), none).unwrap().mesh;
            let mut file = SceneFile::for_mesh("t.obj");
            let load = |file: &SceneFile| {
                file.resolve(|_, _| Ok((mesh.clone().into(), Default::default())))
                    .unwrap()
            };
            let resolved = load(&file);
            let rule = NormalRule {
                source: NormalSource::Auto,
                weight: NormalWeight::Angle,
            };
            let scene = Scene::of_mesh(mesh.clone());
            assert_eq!(scene.objects[0].normals, rule);
            assert_eq!(resolved.scene.objects[0].normals, rule);
            let (a, b) = (scene.frame().unwrap(), resolved.scene.frame().unwrap());
            assert_eq!(std::format!("{a:?}"), std::format!("{b:?}"), "{faces}");
            // The written scene states what was chosen, and means the same.
            file.overlay(resolved.chosen);
            let written = file.to_toml();
            assert!(written.contains("normals = \"auto\"\nnormals_weight = \"angle\"\n"));
            let again = SceneFile::parse(&written, "t.toml").unwrap();
            assert_eq!(load(&again).scene.objects[0].normals, rule);
            // A scene file that states nothing averages as the lecture does.
            let named = SceneFile::parse("[[object]]\nmesh = 't.obj'", "t.toml").unwrap();
            assert_eq!(load(&named).scene.objects[0].normals, NormalRule::default());
        }
    }

    #[cfg(feature = "io")]
    #[test]
    fn an_open_mesh_is_drawn_on_both_sides_if_it_was_read_from_a_file() {
        use crate::mesh::read::parse_mesh;
        let sides = |scene: Scene| (scene.culling, scene.two_sided);
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
        let read = |text: &str| {
            let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
            parse_mesh("t.obj", text.as_bytes(), none).unwrap().mesh
        };
        let open = read(text);
        let mut builder = MeshBuilder::new(open.positions().to_vec());
        open.polygons().for_each(|polygon| {
            builder.polygon(polygon);
        });
        let built = builder.finish().unwrap();
        assert_eq!(sides(Scene::of_mesh(open)), (Culling::None, true));
        assert_eq!(sides(Scene::of_mesh(built)), (Culling::Back, false));
        let closed = read(&std::format!("{text}f 2 3 4\n"));
        assert_eq!(sides(Scene::of_mesh(closed)), (Culling::Back, false));
    }

    #[test]
    fn a_mesh_without_polygons_gives_an_empty_picture() {
        let scene = Scene::of_mesh(MeshBuilder::new(Vec::new()).finish().unwrap());
        let frame = scene.frame().unwrap();
        assert_eq!(
            (frame.polygons().len(), frame.width(), frame.height()),
            (0, 640, 480)
        );
    }
}
