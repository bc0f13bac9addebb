//! The guard of frames: values out of range are refused, wherever they come from, and the error
//! names the item and the value. Directions and normals of any length draw the picture of unit
//! vectors.

use crate::support::{floats_on, plain_lighting};
use fastphong::frame::{
    ClipCorner, DepthRange, Frame, FrameBuilder, FrameError, FrameItem, Mean, SubPixel, Vertex,
};
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::reference::{self, Model};
use fastphong::scene::{
    Clipping, Falloff, Interpolation, Light, Lighting, Place, Projection, Scene,
};
use fastphong::shading::{METHODS, SpanShader, SpanShaderError, SpanVertex, methods};
use glam::{DMat3, DVec3, Vec3};

/// Builds a sphere with a light at infinity and one at a position, seen in perspective.
fn scene() -> Scene {
    let mut scene = Scene::of_mesh(builtin("sphere?rings=6&segments=12").expect("a sphere"));
    (scene.width, scene.height) = (40, 30);
    scene.camera.projection = Projection::Perspective { fovy: 40.0 };
    scene
        .lights
        .push(Light::positional(DVec3::new(3.0, 4.0, 5.0), [0.5; 3]));
    scene
}

/// Every value that a flag or a scene file may not have is refused in a scene, too.
#[test]
fn a_scene_refuses_the_values_that_flags_refuse_and_names_item_and_value() {
    type Change = fn(&mut Scene);
    let orthographic: Change = |s| {
        s.camera.projection = Projection::Orthographic { half_height: -1.0 };
    };
    let changes: &[(Change, &str)] = &[
        (
            |s| s.background[1] = f32::NAN,
            "the picture: green of the background is NaN: expected 0 to 1",
        ),
        (
            |s| s.background[0] = 1.5,
            "the picture: red of the background is 1.5: expected 0 to 1",
        ),
        (
            |s| s.ambient[2] = -0.1,
            "the scene: blue of the ambient light is -0.1: expected 0 or more, up to 3.4e38",
        ),
        (
            orthographic,
            "the camera: the half height is -1: expected a number over 0 (1e-100 to 1e100)",
        ),
        (
            |s| s.camera.projection = Projection::Perspective { fovy: 200.0 },
            "the camera: the field of view is 200: expected degrees over 0 and under 180 (0.001 to 179.999)",
        ),
        (
            |s| s.camera.near = -1.0,
            "the camera: the near distance is -1: expected a number over 0",
        ),
        (
            |s| s.camera.far = 1e300,
            "the camera: the far distance is 1e300: expected numbers between -1e20 and 1e20",
        ),
        (
            |s| s.camera.far = s.camera.near,
            "expected more than the near distance",
        ),
        (
            |s| s.camera.eye = s.camera.target,
            "the camera: the distance from the eye to the target is 0: expected two different points",
        ),
        (
            |s| s.camera.eye.y = 1e16,
            "the camera: y of the eye is 1e16: expected numbers between -1e15 and 1e15",
        ),
        (
            |s| s.camera.up = DVec3::ZERO,
            "the camera: the length of up is 0: expected a direction: not all numbers 0",
        ),
        (
            |s| s.camera.up = s.camera.eye - s.camera.target,
            "the camera: the sine of the angle between up and the line of sight is ",
        ),
        (
            |s| s.lights[0].colour[0] = -2.0,
            "light 0: red of its colour is -2: expected 0 or more, up to 3.4e38",
        ),
        (
            |s| s.lights[0].place = Place::Infinite(DVec3::ZERO),
            "light 0: the length of its direction is 0: expected a direction: not all numbers 0",
        ),
        (
            |s| s.lights[1].place = Place::Local(DVec3::new(0.0, f64::NAN, 0.0)),
            "light 1: y of its position is NaN: expected numbers between -1e15 and 1e15",
        ),
        (
            |s| s.lights[1].falloff = Falloff::Attenuation(-1.0),
            "light 1: its attenuation is -1: expected 0 or more, up to 3.4e38",
        ),
        (
            |s| {
                let vertex = s.objects[0].mesh.positions()[0].as_dvec3();
                s.lights[1].place = Place::Local(vertex);
            },
            "light 1 stands at a vertex, (0, -1, 0)",
        ),
        (
            |s| s.lights = vec![s.lights[0]; 65],
            "65 lights, where at most 64 are possible",
        ),
        (
            |s| {
                s.objects[0].material = Some(Material {
                    shininess: -1.0,
                    ..Material::default()
                })
            },
            "material 0: its exponent is -1: expected 0 or more, up to 3.4e38",
        ),
        (
            |s| {
                s.objects[0].material = Some(Material {
                    diffuse: [0.0, f32::INFINITY, 0.0],
                    ..Material::default()
                })
            },
            "material 0: green of its diffuse part is inf: expected 0 or more, up to 3.4e38",
        ),
        (
            |s| {
                s.lights[1].colour = [1e30; 3];
                s.objects[0].material = Some(Material {
                    specular: [1e30; 3],
                    ..Material::default()
                });
            },
            "light 1 on material 0: red of its specular part is inf: expected 0 or more, up to 3.4e38",
        ),
        (
            |s| s.objects[0].transform.matrix3 = DMat3::from_diagonal(DVec3::new(1.0, 1e-200, 1.0)),
            "object 0: the size that its transform gives to y is 1e-200: expected 1e-15 to 1e15",
        ),
        (
            |s| s.objects[0].transform.matrix3.z_axis = s.objects[0].transform.matrix3.x_axis,
            "object 0: the volume that its transform leaves of a cube is 0: expected over 1e-12",
        ),
        (
            |s| s.objects[0].transform.translation.x = 1e15,
            "object 0: x of a position in the world is ",
        ),
        (
            |s| s.objects[0].normals = NormalSource::Crease(f64::NAN).into(),
            "object 0: the crease angle of its normals is NaN: expected degrees between 0 and 180",
        ),
    ];
    assert!(scene().frame().is_ok());
    for (number, (change, expected)) in changes.iter().enumerate() {
        let mut scene = scene();
        change(&mut scene);
        let error = scene
            .frame()
            .expect_err("a number out of its range")
            .to_string();
        assert!(
            error.starts_with(expected) || error.ends_with(expected),
            "{number}: {error}"
        );
    }
}

/// A prepared scene checks again everything that may have changed since.
#[test]
fn a_prepared_scene_refuses_later_changes_to_bad_values() {
    let mut prepared = scene().prepare().expect("a scene");
    prepared.materials_mut()[0].diffuse[0] = -1.0;
    let error = prepared.frame().expect_err("a negative coefficient");
    let item = FrameItem::Material(0);
    assert!(
        matches!(error, FrameError::Value { item: found, .. } if found == item),
        "{error}"
    );
    prepared.materials_mut()[0].diffuse[0] = 1.0;
    prepared.set_lights(vec![Light::directional(DVec3::NAN, [1.0; 3])]);
    let error = prepared
        .frame()
        .expect_err("a direction that is none")
        .to_string();
    assert_eq!(
        error,
        "light 0: x of its direction is NaN: expected a finite number"
    );
}

const fn corner(x: i32, y: i32, normal: [f32; 3]) -> Vertex {
    Vertex {
        x: SubPixel::from_bits(256 * x),
        y: SubPixel::from_bits(256 * y),
        depth: 0.5,
        inv_w: 1.0,
        normal,
        material: 0,
    }
}

const Z: [f32; 3] = [0.0, 0.0, 1.0];
const CORNERS: [Vertex; 3] = [corner(1, 1, Z), corner(15, 1, Z), corner(1, 15, Z)];

/// Builds a triangle. The caller changes one of its corners, its normal, or something else.
fn built(
    lighting: Lighting,
    last: Vertex,
    normal: [f32; 3],
    change: impl FnOnce(&mut FrameBuilder),
) -> Result<Frame, FrameError> {
    let mut builder = FrameBuilder::new(16, 16);
    builder.lighting(lighting);
    let [a, b, _] = CORNERS;
    let corners = [a, b, last].map(|vertex| builder.vertex(vertex));
    builder.polygon(&corners, normal, 0);
    change(&mut builder);
    builder.finish()
}

#[test]
fn a_builder_refuses_values_out_of_range_and_names_the_vertex() {
    let last = CORNERS[2];
    let refused = |last: Vertex, normal: [f32; 3], change: fn(&mut FrameBuilder)| {
        let frame = built(plain_lighting(), last, normal, change);
        frame.expect_err("a number out of its range").to_string()
    };
    let none: fn(&mut FrameBuilder) = |_| ();
    for (depth, expected) in [
        (1.5, "1.5"),
        (-0.25, "-0.25"),
        (f64::NAN, "NaN"),
        (1e30, "1e30"),
    ] {
        assert_eq!(
            refused(Vertex { depth, ..last }, Z, none),
            format!("vertex 2: its depth is {expected}: expected 0 to 1")
        );
    }
    for (vertex, expected) in [
        (
            Vertex { inv_w: 0.0, ..last },
            "vertex 2: its near/w is 0: expected a number over 0, up to 1",
        ),
        (
            Vertex {
                inv_w: 1e30,
                ..last
            },
            "vertex 2: its near/w is 1e30: expected a number over 0, up to 1",
        ),
        (
            Vertex {
                normal: [0.0; 3],
                ..last
            },
            "vertex 2: the length of its normal is 0: expected a direction: not all numbers 0",
        ),
        (
            Vertex {
                normal: [0.0, f32::NAN, 1.0],
                ..last
            },
            "vertex 2: y of its normal is NaN: expected a finite number",
        ),
        (
            Vertex {
                material: 7,
                ..last
            },
            "vertex 2: its material is 7: expected the index of a material that was added",
        ),
        (
            Vertex {
                x: SubPixel::from_num(40_000),
                ..last
            },
            "vertex 2: its column is 40000: expected pixels from -32768 to 32768",
        ),
    ] {
        assert_eq!(refused(vertex, Z, none), expected);
    }
    assert_eq!(
        refused(last, [0.0, 0.0, f32::INFINITY], none),
        "polygon 0: z of its normal is inf: expected a finite number"
    );
    type Change = fn(&mut FrameBuilder);
    let changes: &[(Change, &str)] = &[
        (
            |b| {
                b.background([0.0, f32::NAN, 0.0]);
            },
            "the picture: green of the background is NaN: expected 0 to 1",
        ),
        (
            |b| {
                b.depth_range(DepthRange::Perspective {
                    near: 0.0,
                    far: 1.0,
                });
            },
            "the camera: the near distance is 0: expected a number over 0 (up to 1e20), as the camera is a perspective one",
        ),
        (
            |b| {
                b.position(0, [0.0; 3]);
            },
            "vertex 1 has no position: expected one for every vertex, as a light or the eye is at a position, or other \
             vertices have theirs",
        ),
        (
            |b| {
                (0..3).for_each(|v| {
                    b.position(v, [0.0, 1e30, 0.0]);
                });
            },
            "vertex 0: y of its position is 1e30: expected numbers between -1e16 and 1e16",
        ),
        (
            |b| {
                b.attributes(1, [0.0, 0.0, f32::NAN, 0.0]);
            },
            "vertex 1: an attribute is NaN: expected a finite number",
        ),
        (
            |b| {
                b.mean(Mean {
                    position: [0.0; 3],
                    normal: [f32::NAN, 0.0, 0.0],
                    colour: [1.0; 3],
                });
            },
            "polygon 1: x of its mean normal is NaN: expected a finite number",
        ),
        (
            |b| {
                b.clip_corner(ClipCorner {
                    vertex: 2,
                    a: 0,
                    b: 1,
                    t: 1.5,
                    face: Z,
                });
            },
            "clip corner 0: its parameter is 1.5: expected 0 to 1",
        ),
    ];
    for (change, expected) in changes {
        assert_eq!(refused(last, Z, *change), *expected);
    }
    // Without near and far planes depth may have any value, and decides at each sample.
    let cube = |b: &mut FrameBuilder| {
        b.clipping(Clipping::NdcCube);
    };
    assert!(built(plain_lighting(), Vertex { depth: 1.5, ..last }, Z, cube).is_ok());
}

/// A stated mean has the colours that vertices may have: none below 0 where they multiply a
/// material.
#[test]
fn a_mean_has_no_colour_below_0_where_colours_multiply_the_material() {
    let with_mean = |vertex_colours: bool, red: f32| {
        let mut lighting = plain_lighting();
        lighting.vertex_colours = vertex_colours;
        built(lighting, CORNERS[2], Z, |b| {
            let [x, y, z] = [0, 1, 2].map(|corner| b.vertex(CORNERS[corner]));
            b.mean(Mean {
                position: [0.0; 3],
                normal: Z,
                colour: [red, 0.5, 0.5],
            });
            b.polygon(&[x, y, z], Z, 1);
        })
    };
    assert_eq!(
        with_mean(true, -0.5).expect_err("no colour").to_string(),
        "polygon 1: red of its colour is -0.5: expected 0 or more, up to 3.4e38"
    );
    assert!(with_mean(true, 0.5).is_ok() && with_mean(false, -0.5).is_ok());
}

/// A far plane at infinity, which matrices without one have, draws the picture of the farthest
/// plane.
#[test]
fn a_far_plane_at_infinity_is_the_farthest_one() {
    let picture = |frame: &Frame| methods::GOURAUD.variant().render(frame).expect("any frame");
    for projection in [
        Projection::Perspective { fovy: 40.0 },
        Projection::Orthographic { half_height: 2.0 },
    ] {
        let drawn = |far: f64| {
            let mut scene = scene();
            (scene.camera.projection, scene.camera.far) = (projection, far);
            assert!(scene.camera.clip_matrix(1.5).is_finite());
            picture(&scene.frame().expect("a frame"))
        };
        assert!(drawn(f64::INFINITY) == drawn(1e20));
    }
    let drawn = |far: f64| {
        let mut builder = FrameBuilder::new(16, 16);
        builder
            .depth_range(DepthRange::Perspective { near: 0.1, far })
            .lighting(plain_lighting());
        let corners = [
            [-3.0, -3.0, 0.0, 4.0],
            [90.0, -3.0, 0.0, 100.0],
            [-3.0, 90.0, 0.0, -1.0],
        ]
        .map(|place| builder.vertex_from_clip(place, Z, 0));
        builder.polygon(&corners, Z, 0);
        let frame = builder.finish().expect("a frame");
        assert!(frame.stats().clipped == 1 && frame.depth_range().z(-1.0 / 4.0).is_finite());
        picture(&frame)
    };
    assert!(drawn(f64::INFINITY) == drawn(1e20));
    let refused = |near: f64, far: f64| {
        let mut scene = scene();
        (scene.camera.near, scene.camera.far) = (near, far);
        scene.frame().expect_err("no depth").to_string()
    };
    assert_eq!(
        refused(1.0, f64::NEG_INFINITY),
        "the camera: the far distance is -inf: expected numbers between -1e20 and 1e20, or infinity"
    );
    assert_eq!(
        refused(f64::INFINITY, f64::INFINITY),
        "the camera: the near distance is inf: expected a number over 0 (up to 1e20), as the camera is a perspective one"
    );
}

/// Without positions, a positional light would light every point as if it were at 0.
#[test]
fn a_light_at_a_position_needs_the_positions_of_vertices() {
    let near = [Light::positional(DVec3::Z, [1.0; 3])];
    let lighting = Lighting::new(&Material::default(), [1.0; 3], &near, DVec3::Z);
    let error = built(lighting.clone(), CORNERS[2], Z, |_| ());
    assert_eq!(
        error.expect_err("no positions"),
        FrameError::Position { index: 0 }
    );
    let most = |b: &mut FrameBuilder| {
        b.position(0, [0.0; 3]).position(2, [1.0; 3]);
    };
    let error = built(lighting.clone(), CORNERS[2], Z, most);
    assert_eq!(
        error.expect_err("one is missing"),
        FrameError::Position { index: 1 }
    );
    let all = |b: &mut FrameBuilder| {
        (0..3).for_each(|v| {
            b.position(v, [0.1; 3]);
        });
    };
    assert!(built(lighting, CORNERS[2], Z, all).is_ok());
}

/// All methods and the reference draw the same bits for normals and directions of any length.
#[test]
fn directions_and_normals_of_any_length_draw_the_picture_of_unit_vectors() {
    let leaning = [[-0.3, 0.1, 1.0], [0.4, 0.2, 1.0], [0.1, -0.5, 1.0]].map(Vec3::from_array);
    let frame = |length: f32, interpolation| {
        // Powers of two change no digit.
        let of_light = DVec3::new(0.2, 0.3, 1.0) * f64::from(length);
        let light = Light::directional(of_light, [0.8; 3]);
        let view = DVec3::new(0.1, 0.0, 1.0) * f64::from(length);
        let mut builder = FrameBuilder::new(16, 16);
        builder.interpolation(interpolation);
        builder.lighting(Lighting::new(
            &Material::default(),
            [1.0; 3],
            &[light],
            view,
        ));
        let corners = [0, 1, 2].map(|i| {
            let normal = (leaning[i] * length).to_array();
            builder.vertex(Vertex {
                normal,
                ..CORNERS[i]
            })
        });
        builder.mean_of(&corners);
        builder.polygon(&corners, [0.0, 0.25 * length, length], 0);
        builder.finish().expect("a frame")
    };
    let mut compared = 0;
    for interpolation in [Interpolation::Screen, Interpolation::Perspective] {
        let expected = frame(1.0, interpolation);
        for length in [0.25, 2f32.powi(100), 2f32.powi(-100)] {
            let frame = frame(length, interpolation);
            for entry in floats_on(&expected) {
                let [a, b] = [&frame, &expected].map(|frame| {
                    let picture = entry.variant().render_linear(frame);
                    picture.expect("a method for the frame")
                });
                assert_eq!(a, b, "{} at length {length}", entry.info.name);
                compared += 1;
            }
            for model in Model::ALL {
                let [a, b] =
                    [&frame, &expected].map(|frame| reference::render(frame, model).picture);
                assert_eq!(a, b, "{model:?}");
            }
        }
        let middle = expected.normal(0);
        let length = Vec3::from_array(middle).length();
        // It is rounded from `f64` to `f32`, and its square once more.
        assert!((length - 1.0).abs() < 3e-7, "{length}");
    }
    assert!(compared > 100);

    let mut scene = scene();
    let expected = scene.frame().expect("a frame");
    scene.camera.up *= 2f64.powi(900);
    let Place::Infinite(toward) = &mut scene.lights[0].place else {
        unreachable!("a light at infinity")
    };
    *toward *= 2f64.powi(-900);
    let frame = scene.frame().expect("a frame");
    assert_eq!(frame.vertices(), expected.vertices());
    for (a, b) in frame.lightings().iter().zip(expected.lightings()) {
        let [Place::Infinite(a), Place::Infinite(b)] = [a.lights[0].place, b.lights[0].place]
        else {
            unreachable!("lights at infinity")
        };
        assert!(Vec3::from_array(a).distance(Vec3::from_array(b)) < 1e-6);
    }
}

/// A vector that was normalised in `f32` keeps its bits: normalising it again would not improve it.
#[test]
fn unit_vectors_keep_their_bits() {
    let mut random = crate::support::Random::new(41);
    for _ in 0..1000 {
        let [x, y, z] = [0; 3].map(|_| random.share() - 0.5);
        let normal = Vec3::new(x, y, z).normalize().to_array();
        let frame =
            built(plain_lighting(), corner(1, 15, normal), normal, |_| ()).expect("a frame");
        let bits = |v: [f32; 3]| v.map(f32::to_bits);
        assert_eq!(bits(frame.normal(2)), bits(normal));
        assert_eq!(
            bits(frame.polygon_normal(&frame.polygons()[0])),
            bits(normal)
        );
    }
    let off = [0.0, 0.0, 1.0 + 2f32.powi(-19)];
    let frame = built(plain_lighting(), corner(1, 15, off), Z, |_| ()).expect("a frame");
    assert_eq!(frame.normal(2), Z);
}

#[test]
fn a_span_shader_refuses_what_a_builder_refuses() {
    let light = Light::directional(DVec3::Z, [1.0; 3]);
    let shader = |lighting: &Lighting| {
        let variant = methods::PHONG_RSQRT.variant();
        SpanShader::new(&variant, lighting, Interpolation::Screen)
    };
    let lit = |lights: &[Light]| Lighting::new(&Material::default(), [1.0; 3], lights, DVec3::Z);
    let refused = |lighting: &Lighting| shader(lighting).err().map(|error| error.to_string());
    assert_eq!(
        refused(&lit(&[light; 65])).as_deref(),
        Some("65 lights, where at most 64 are possible, the same on every material")
    );
    for entry in METHODS {
        let many = SpanShader::new(&entry.variant(), &lit(&[light; 65]), Interpolation::Screen);
        let found = FrameError::Lights { found: 65 };
        assert_eq!(
            many.err(),
            Some(SpanShaderError::Lighting(found)),
            "{}",
            entry.info.name
        );
    }
    let mut lighting = lit(&[light]);
    lighting.ambient[0] = f32::NAN;
    assert_eq!(
        refused(&lighting).as_deref(),
        Some("material 0: red of its ambient part is NaN: expected 0 or more, up to 3.4e38")
    );
    let nowhere = lit(&[Light::directional(DVec3::ZERO, [1.0; 3])]);
    assert_eq!(
        refused(&nowhere).as_deref(),
        Some(
            "light 0 on material 0: the length of its direction is 0: expected a direction: not all numbers 0"
        )
    );
    // Normals and directions may have any length.
    let colour = |length: f64| {
        let light = Light::directional(DVec3::Z * length, [0.5; 3]);
        let mut shader = shader(&lit(&[light])).expect("a direction");
        let normal = [0.0, 0.6 * length as f32, 0.8 * length as f32];
        let end = shader.vertex(SpanVertex::of_normal(normal));
        let mut colours = [[0.0; 3]; 1];
        shader.shade([(0.0, &end), (1.0, &end)], [0, 0], &mut colours);
        colours[0]
    };
    for length in [4.0, 1e30, 1e-30] {
        let (ours, expected) = (colour(length), colour(1.0));
        assert!(
            (0..3).all(|c| (ours[c] - expected[c]).abs() < 1e-6),
            "{ours:?} {expected:?}"
        );
    }
    let mut dark = shader(&lit(&[light])).expect("a light");
    let end = dark.vertex(SpanVertex::of_normal([f32::NAN, 0.0, 1.0]));
    let mut colours = [[0.0; 3]; 1];
    dark.shade([(0.0, &end), (1.0, &end)], [0, 0], &mut colours);
    assert_eq!(colours[0], Material::default().ambient);
}

/// Drawing by a method that cannot draw a frame is an error, and all its other functions do not
/// panic.
#[test]
fn a_method_that_cannot_draw_a_frame_returns_an_error_and_does_not_panic() {
    let mut scene = scene();
    scene.interpolation = Interpolation::Perspective;
    scene
        .lights
        .extend([Light::directional(DVec3::X, [0.1; 3]); 9]);
    let frame = scene.frame().expect("a frame");
    let mut refused = 0;
    for entry in METHODS {
        let variant = entry.variant();
        let plan = variant.plan(&frame, fastphong::raster::Renderer::LECTURE);
        let reason = match plan {
            fastphong::raster::Plan::Refused(reason) => Some(reason),
            _ => None,
        };
        let error = reason.map(fastphong::raster::DrawError::Refused);
        assert_eq!(variant.render(&frame).err(), error, "{variant}");
        assert_eq!(variant.render_linear(&frame).err(), error, "{variant}");
        assert!((0.0..=1.0).contains(&variant.bound(&frame)), "{variant}");
        assert!(variant.approximation(&frame) >= 0.0, "{variant}");
        variant.polygon_kinds(&frame);
        variant.polygon_indices(&frame, fastphong::raster::Renderer::fastest());
        refused += usize::from(error.is_some());
    }
    assert!(refused >= 7, "methods in integers at least");
}
