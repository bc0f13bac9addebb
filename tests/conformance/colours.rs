//! Lit vertex colours: every method and engine against the reference, on the shipped scenes with
//! added colours.

use super::accuracy::check_all;
use super::support::cases::Case;
use super::support::{Random, floats_on, scene, shipped};
use fastphong::frame::{FrameBuilder, FrameError, SubPixel, Vertex};
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::{Material, MeshBuilder, PolygonMesh};
use fastphong::raster::{Plan, Renderer};
use fastphong::reference::{self, Model};
use fastphong::scene::{Interpolation, Lighting, Scene};
use fastphong::shading::{METHODS, SpanShader, SpanVertex, Variant};
use glam::{DVec3, Vec3};
use std::sync::Arc;

const SIZE: (i64, i64) = (64, 48);

/// Returns a mesh with a colour at each position. Some channels are over 1 and some are 0.
fn coloured(mesh: &PolygonMesh) -> PolygonMesh {
    let mut builder = MeshBuilder::new(mesh.positions().to_vec());
    mesh.polygons().for_each(|polygon| {
        builder.polygon(polygon);
    });
    if let Some(normals) = mesh.given_normals() {
        builder.normals(normals.clone());
    }
    let polygons = 0..mesh.polygon_count();
    let material = |p| mesh.polygon_material(p).map_or(u32::MAX, |m| m as u32);
    builder.materials(mesh.materials().to_vec(), polygons.map(material).collect());
    let mut random = Random::new(7);
    let mut channel = || (1.6 * random.signed().abs() - 0.2).max(0.0);
    let colours = mesh
        .positions()
        .iter()
        .map(|_| Vec3::new(channel(), channel(), channel()));
    builder.colours(colours.collect());
    builder.finish().expect("a mesh with colours")
}

/// Returns a shipped scene whose first object has colours.
fn coloured_scene(name: &str) -> Scene {
    let mut scene = scene(name, Some(SIZE));
    let mesh = &mut scene.objects[0].mesh;
    *mesh = Arc::new(coloured(mesh));
    scene.colours = true;
    scene
}

/// The shipped scenes with so few polygons that every method and engine can draw them once more.
fn scenes() -> impl Iterator<Item = (String, Scene)> {
    let all = shipped().into_iter().map(|name| {
        let scene = coloured_scene(&name);
        (name, scene)
    });
    all.filter(|(_, scene)| scene.objects[0].mesh.polygon_count() < 5_000)
}

/// The scenes cover every float method and engine, lights at infinity and at positions,
/// interpolation on the screen and in space, and clipped and whole polygons.
#[test]
fn every_method_is_within_its_bound() {
    let cases: Vec<Case> = scenes()
        .flat_map(|(name, mut scene)| {
            let own = Case::new(
                format!("{name} in colours"),
                scene.frame().expect("a frame"),
            );
            scene.interpolation = match scene.interpolation {
                Interpolation::Screen => Interpolation::Perspective,
                Interpolation::Perspective => Interpolation::Screen,
            };
            let other = scene
                .frame()
                .ok()
                .map(|frame| Case::new(format!("{name} in colours, other"), frame));
            [Some(own), other].into_iter().flatten()
        })
        .collect();
    assert!(cases.len() > 20, "{} cases", cases.len());
    let shares = check_all(&cases);
    let drawn: std::collections::BTreeSet<&str> = shares.iter().map(|share| share.1).collect();
    assert!(drawn.len() > 28, "{drawn:?}");
}

/// The colours change the pictures of all float methods, but only where the scene asks for them.
#[test]
fn without_colours_pictures_equal_those_of_plain_meshes() {
    let plain = scene("football", Some(SIZE));
    let mut scene = coloured_scene("football");
    let lit = scene.frame().expect("a frame");
    scene.colours = false;
    let (off, plain) = (
        scene.frame().expect("a frame"),
        plain.frame().expect("a frame"),
    );
    for entry in floats_on(&plain) {
        let [lit, off, plain] = [&lit, &off, &plain].map(|frame| {
            let picture = entry.variant().render(frame);
            picture.expect("a method for the frame")
        });
        assert!(off == plain, "{}", entry.info.name);
        assert!(lit != plain, "{}", entry.info.name);
    }
}

/// Methods in integers say why they do not draw colours.
#[test]
fn methods_in_integers_refuse_colours() {
    let frame = coloured_scene("coarse-sphere").frame().expect("a frame");
    let mut count = 0;
    for entry in METHODS.iter().filter(|entry| entry.is_integer) {
        let plan = entry.variant().plan(&frame, Renderer::LECTURE);
        assert!(
            matches!(plan, Plan::Refused(why) if why.contains("--colours off")),
            "{plan:?}"
        );
        count += 1;
    }
    assert_eq!(count, 7);
}

/// The colours in every line of every trace equal the picture's to the bit.
#[test]
fn traces_have_the_colours_of_the_picture() {
    for name in ["coarse-sphere", "perspective", "local-lights", "polygons"] {
        let frame = coloured_scene(name).frame().expect("a frame");
        for entry in floats_on(&frame) {
            let variant = entry.variant();
            let picture = variant.render_linear(&frame).expect("a method for it");
            let trace = variant.trace(&frame, Some(24)).expect("a method for it");
            let mut pixels = 0;
            for run in trace.lines.iter().flat_map(|line| &line.runs) {
                for (x, colour) in (run.x as usize..).zip(&run.colours) {
                    assert_eq!(
                        colour[..],
                        picture.get(x, 24)[..3],
                        "{name}, {variant}: {x}"
                    );
                    pixels += 1;
                }
            }
            assert!(pixels > 5, "{name}, {variant}: {pixels} pixels");
        }
    }
}

/// A square that faces light and eye, with two red corners and two of colour (0, 2, ½). By hand:
/// ambient and diffuse light times the colour, plus the highlight.
#[test]
fn light_is_the_colour_times_ambient_and_diffuse_plus_the_highlight() {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let positions = corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec();
    let mut builder = MeshBuilder::new(positions);
    builder.polygon(&[0, 1, 2, 3]);
    let [red, other] = [Vec3::X, Vec3::new(0.0, 2.0, 0.5)];
    builder.colours(vec![red, red, other, other]);
    let mut scene = Scene::of_mesh(builder.finish().expect("a square"));
    scene.objects[0].material = Some(Material {
        ambient: [0.125; 3],
        diffuse: [0.25; 3],
        specular: [0.0, 0.0, 0.25],
        shininess: 1.0,
    });
    (scene.width, scene.height) = (8, 8);
    let distance = (scene.camera.eye - scene.camera.target).length();
    scene.camera.eye = scene.camera.target + distance * DVec3::Z;
    scene.camera.up = DVec3::Y;
    scene.lights[0].place = fastphong::scene::Place::Infinite(DVec3::Z);
    let frame = scene.frame().expect("a frame");
    let mean = [0.5 * 0.375, 0.375, 0.25 * 0.375 + 0.25];
    for entry in floats_on(&frame) {
        let picture = entry.variant().render_linear(&frame).expect("for it");
        let [above, below] = [3, 4].map(|y| picture.get(4, y));
        // The middle of the square, half-way between rows 3 and 4, has the mean of the colours.
        // Each is off by its bound.
        for (c, mean) in mean.into_iter().enumerate() {
            let off = (above[c] + below[c]) / 2.0 - mean;
            let bound = entry.variant().bound(&frame) as f32;
            assert!(
                off.abs() <= bound,
                "{}: {off} over {bound}",
                entry.info.name
            );
        }
        let is_one_colour =
            entry.info.model == Model::Flat || entry.info.model == Model::FlatAverage;
        assert_eq!(above == below, is_one_colour, "{}", entry.info.name);
    }
}

/// Colours are checked only where they are lit.
#[test]
fn colours_below_0_are_refused_where_they_are_lit() {
    let mut mesh = MeshBuilder::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y]);
    mesh.polygon(&[0, 1, 2]);
    mesh.colours(vec![Vec3::ONE, Vec3::new(0.5, -0.25, 0.5), Vec3::ONE]);
    let mut scene = Scene::of_mesh(mesh.finish().expect("a triangle"));
    let error = scene.frame().expect_err("a colour below 0").to_string();
    assert_eq!(
        error,
        "object 0: green of a vertex colour is -0.25: expected 0 or more, up to 3.4e38"
    );
    scene.colours = false;
    assert!(scene.frame().is_ok());

    for (is_lit, expected) in [
        (false, None),
        (
            true,
            Some("vertex 0: red of its colour is -1: expected 0 or more, up to 3.4e38"),
        ),
    ] {
        let mut builder = FrameBuilder::new(8, 8);
        let mut lighting = Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z);
        lighting.vertex_colours = is_lit;
        let material = builder.lighting(lighting);
        let vertex = builder.vertex(Vertex {
            x: SubPixel::ZERO,
            y: SubPixel::ZERO,
            depth: 0.5,
            inv_w: 1.0,
            normal: [0.0, 0.0, 1.0],
            material,
        });
        builder.colour(vertex, [-1.0, 0.0, 0.0]);
        let found = builder
            .finish()
            .err()
            .map(|error: FrameError| error.to_string());
        assert_eq!(found.as_deref(), expected);
    }
}

/// A mesh with colours keeps its material, or gets a grey one if it has none.
#[test]
fn a_mesh_with_colours_and_no_material_is_lit_in_them() {
    let mesh = builtin("terrain?segments=8&rows=8&colours=true").expect("a built-in mesh");
    let scene = Scene::of_mesh(mesh);
    let material = scene.objects[0].material.expect("a material");
    assert_eq!(material.diffuse, [material.diffuse[0]; 3], "grey");
    let frame = scene.frame().expect("a frame");
    assert!(frame.lightings()[0].vertex_colours);
    let picture = reference::render(&frame, Model::Phong).to_picture8();
    let is_green = |p: &&[u8; 4]| p[1] > p[0] && p[1] > p[2];
    assert!(picture.pixels().iter().filter(is_green).count() > 100);
}

/// A span shader lights the colours of its vertices like the engine.
#[test]
fn span_shaders_light_colours() {
    let light = fastphong::scene::Light::directional(DVec3::Z, [1.0; 3]);
    let material = Material {
        ambient: [0.0; 3],
        diffuse: [1.0; 3],
        specular: [0.0; 3],
        shininess: 1.0,
    };
    let mut lighting = Lighting::new(&material, [1.0; 3], &[light], DVec3::Z);
    lighting.vertex_colours = true;
    for method in ["naive-phong", "fast-phong", "gouraud", "slerp-phong"] {
        let variant = Variant::parse(method).expect("a method");
        let mut shader =
            SpanShader::new(&variant, &lighting, Interpolation::Screen).expect("for it");
        if shader.wants_polygons() {
            continue;
        }
        let [left, right] = [0.0, 1.0].map(|red| {
            shader.vertex(SpanVertex {
                attributes: [red, 1.0, 0.5, 1.0],
                ..SpanVertex::of_normal([0.0, 0.0, 1.0])
            })
        });
        let mut colours = [[0.0; 3]; 4];
        shader.shade([(0.0, &left), (4.0, &right)], [0, 0], &mut colours);
        for (x, colour) in colours.into_iter().enumerate() {
            let expected = [(x as f32 + 0.5) / 4.0, 1.0, 0.5];
            for (found, expected) in colour.into_iter().zip(expected) {
                // The normal, the colour and their product take a few roundings of values of at
                // most 1.
                let off = (found - expected).abs();
                assert!(off <= 8.0 * f32::EPSILON, "{method}: {colour:?}");
            }
        }
    }
}
