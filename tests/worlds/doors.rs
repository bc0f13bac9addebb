//! The two doors to a picture: a scene file, which the program reads and checks, and a scene whose
//! fields a caller sets. Both must refuse and draw the same scenes.

use super::scene;
use super::wild::{Change, changed, changes};
use super::world::World;
use fastphong::frame::Frame;
use fastphong::mesh::vertex_normals::{NormalSource, NormalWeight};
use fastphong::picture::{Encoding, LinearPicture};
use fastphong::scene::file::SceneFile;
use fastphong::scene::{
    Clipping, Culling, DepthBits, DepthSource, Falloff, HiddenSurfaces, Interpolation, PainterKey,
    Place, Projection, Scene, SpecularGate, SpecularModel,
};
use fastphong::shading::Variant;
use proptest::prelude::*;
use std::fmt::Write;
use std::path::Path;

/// The result of the two doors for a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Both refuse it.
    Refused,
    /// Both draw it.
    Drawn,
    /// Both draw it from equal unit vectors, so their pictures are equal to the bit.
    Equal,
}

/// A scene that a caller makes: a world, changes of some of its numbers, and a length for each
/// direction.
pub type Made = (World, Vec<Change>, Vec<f64>);

/// Returns worlds whose directions have any length. Some have numbers that no caller should set.
pub fn made() -> BoxedStrategy<Made> {
    let length = prop_oneof![
        3 => Just(1.0),
        3 => super::numbers::size(-30.0..30.0),
        1 => super::numbers::size(-300.0..300.0),
    ];
    let changes = prop_oneof![1 => Just(Vec::new()), 1 => changes()];
    (
        scene::worlds(),
        changes,
        prop::collection::vec(length, 1..8),
    )
        .boxed()
}

/// Draws a scene through both doors.
///
/// # Errors
/// The difference between the two, in words.
pub fn check(scene: Scene, numbers: &[Change], lengths: &[f64]) -> Result<Outcome, String> {
    let mut scene = changed(scene, numbers);
    stretch(&mut scene, lengths);
    let text = text(&scene);
    let ours = scene.frame().map_err(|error| error.to_string());
    let theirs = read(&text, &scene).and_then(|scene| {
        let frame = scene.frame().map_err(|error| error.to_string())?;
        Ok((scene, frame))
    });
    match (ours, theirs) {
        (Err(_), Err(_)) => Ok(Outcome::Refused),
        (Err(error), Ok(_)) => Err(format!("only the library refuses: {error}\n{text}")),
        (Ok(_), Err(error)) => Err(format!("only the file is refused: {error}\n{text}")),
        (Ok(ours), Ok((read, theirs))) => {
            let is_same = has_same_directions(&scene, &read);
            // If the eye is so near to its target that rounding of coordinates matters, the last
            // bit of a direction turns the picture.
            let camera = &scene.camera;
            let is_coarse = (camera.eye - camera.target).length() < 1e-9 * camera.eye.length();
            if is_coarse && !is_same {
                return Ok(Outcome::Drawn);
            }
            compare(&ours, &theirs, is_same).map_err(|problem| format!("{problem}\n{text}"))
        }
    }
}

/// Multiplies directions by lengths, the first light's by the first one, and so on.
fn stretch(scene: &mut Scene, lengths: &[f64]) {
    let lights = scene
        .lights
        .iter_mut()
        .filter_map(|light| match &mut light.place {
            Place::Infinite(toward) => Some(toward),
            Place::Local(_) => None,
        });
    let directions = lights.chain([&mut scene.camera.up]);
    for (direction, length) in directions.zip(lengths.iter().cycle()) {
        *direction *= *length;
    }
}

/// True if both doors have equal unit vectors. The library does not change vectors whose length is
/// 1 up to rounding, but reading a file rounds them once more.
fn has_same_directions(scene: &Scene, read: &Scene) -> bool {
    let directions = |scene: &Scene| {
        let lights = scene.lights.iter().filter_map(|light| match light.place {
            Place::Infinite(toward) => Some(toward),
            Place::Local(_) => None,
        });
        lights.chain([scene.camera.up]).collect::<Vec<_>>()
    };
    let mut pairs = directions(scene).into_iter().zip(directions(read));
    pairs.all(|(ours, theirs)| ours == theirs || (ours.length() - 1.0).abs() > 1e-6)
}

/// Compares the two pictures of a scene by two methods, one of which computes light at vertices.
fn compare(ours: &Frame, theirs: &Frame, is_same: bool) -> Result<Outcome, String> {
    for method in ["gouraud", "naive-phong"] {
        let variant = Variant::parse(method).expect("a method");
        let [ours, theirs] = [ours, theirs].map(|frame| {
            let picture = variant.render_linear(frame);
            picture.expect("a method for any frame")
        });
        let apart = |level: f32| count_apart(&ours, &theirs, level);
        if is_same && apart(0.0) > 0 {
            return Err(format!("{method}: {} pixels differ", apart(0.0)));
        }
        // Directions that differ in their last bits move edges, and the borders of highlights,
        // across the centres of a few pixels.
        let (pixels, found) = (ours.pixels().len(), apart(1.0 / 255.0));
        if found > 8 + pixels / 50 {
            return Err(format!("{method}: {found} of {pixels} pixels differ"));
        }
    }
    Ok(if is_same {
        Outcome::Equal
    } else {
        Outcome::Drawn
    })
}

fn count_apart(a: &LinearPicture, b: &LinearPicture, level: f32) -> usize {
    let pairs = a.pixels().iter().zip(b.pixels());
    let differ = |(a, b): &(&[f32; 4], &[f32; 4])| {
        let mut channels = a.iter().zip(b.iter());
        !channels.all(|(a, b)| (a - b).abs() <= level)
    };
    pairs.filter(differ).count()
}

/// Reads a scene as the program does. Each mesh is named by its index in `scene`.
fn read(text: &str, scene: &Scene) -> Result<Scene, String> {
    let file = SceneFile::parse(text, "made.toml").map_err(|error| error.render(false))?;
    let load = |name: &str, _: &Path| {
        let number: usize = name.parse().expect("a number");
        Ok((scene.objects[number].mesh.clone(), Default::default()))
    };
    let resolved = file.resolve(load).map_err(|error| error.render(false))?;
    Ok(resolved.scene)
}

/// Writes a scene with all its numbers as a scene file.
fn text(scene: &Scene) -> String {
    let mut text = String::new();
    // An `f32` is converted to `f64` and written with all its digits.
    let three = |v: [f32; 3]| format!("{:?}", v.map(f64::from));
    settings(scene, &mut text);
    let _ = write!(
        text,
        "ambient = {}\n[image]\nwidth = {}\nheight = {}\nsamples = {}\nbackground = {}\n",
        three(scene.ambient),
        scene.width,
        scene.height,
        scene.samples,
        three(scene.background),
    );
    if scene.encoding == Encoding::Srgb {
        text.push_str("encoding = 'srgb'\n");
    }
    let camera = &scene.camera;
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(|v| v.to_array());
    let (key, size) = match camera.projection {
        Projection::Orthographic { half_height } => ("half_height", half_height),
        Projection::Perspective { fovy } => ("fovy", fovy),
    };
    let _ = write!(
        text,
        "[camera]\neye = {eye:?}\ntarget = {target:?}\nup = {up:?}\n{key} = {size:?}\nnear = {:?}\nfar = {:?}\n",
        camera.near, camera.far
    );
    if scene.lights.is_empty() {
        text.insert_str(0, "light = []\n");
    }
    for light in &scene.lights {
        let (key, at) = match light.place {
            Place::Infinite(v) => ("direction", v),
            Place::Local(v) => ("position", v),
        };
        let _ = writeln!(
            text,
            "[[light]]\n{key} = {:?}\ncolour = {}",
            at.to_array(),
            three(light.colour)
        );
        let _ = match light.falloff {
            Falloff::None => Ok(()),
            Falloff::Attenuation(k) => writeln!(text, "attenuation = {:?}", f64::from(k)),
            Falloff::InverseSquare => writeln!(text, "falloff = 'inverse-square'"),
            Falloff::Inverse => writeln!(text, "falloff = 'inverse'"),
        };
    }
    for (number, object) in scene.objects.iter().enumerate() {
        let (m, t) = (object.transform.matrix3, object.transform.translation);
        let row = |i: usize| [m.x_axis[i], m.y_axis[i], m.z_axis[i], t[i]];
        let rows = [row(0), row(1), row(2)];
        let _ = writeln!(text, "[[object]]\nmesh = '{number}'\nmatrix = {rows:?}");
        let _ = match object.normals.source {
            NormalSource::Auto => writeln!(text, "normals = 'auto'"),
            NormalSource::Averaged => writeln!(text, "normals = 'averaged'"),
            NormalSource::Given => writeln!(text, "normals = 'given'"),
            NormalSource::Crease(degrees) => writeln!(text, "crease = {degrees:?}"),
        };
        let weight = match object.normals.weight {
            NormalWeight::Uniform => "uniform",
            NormalWeight::Area => "area",
            NormalWeight::Angle => "angle",
            NormalWeight::Max => "max",
        };
        let _ = writeln!(text, "normals_weight = '{weight}'");
        if let Some(material) = object.material {
            let _ = writeln!(
                text,
                "material = {{ ka = {}, kd = {}, ks = {}, shininess = {:?} }}",
                three(material.ambient),
                three(material.diffuse),
                three(material.specular),
                f64::from(material.shininess)
            );
        }
    }
    text
}

/// Writes the settings whose values are words.
fn settings(scene: &Scene, text: &mut String) {
    let mut line = |key: &str, value: &str| {
        let _ = writeln!(text, "{key} = '{value}'");
    };
    let model = |model| match model {
        SpecularModel::Phong => "phong",
        SpecularModel::Blinn => "blinn",
    };
    line("specular", model(scene.specular));
    line("shininess_for", model(scene.shininess_for));
    match scene.gate {
        SpecularGate::Gated => line("specular_gate", "gated"),
        SpecularGate::Ungated => line("specular_gate", "ungated"),
        SpecularGate::Weighted => line("specular_gate", "weighted"),
    }
    if scene.local_viewer {
        line("viewer", "local");
    }
    if scene.interpolation == Interpolation::Perspective {
        line("interpolation", "perspective");
    }
    match scene.culling {
        Culling::Back => line("cull", "back"),
        Culling::Front => line("cull", "front"),
        Culling::None => line("cull", "none"),
    }
    if scene.clipping == Clipping::NdcCube {
        line("clipping", "ndc-cube");
    }
    let mut bits = 32;
    match scene.hidden_surfaces {
        HiddenSurfaces::DrawOrder => line("visibility", "draw-order"),
        HiddenSurfaces::Painter(key) => {
            line("visibility", "painter");
            match key {
                PainterKey::Mean => line("painter_key", "mean"),
                PainterKey::Farthest => line("painter_key", "farthest"),
            }
        }
        HiddenSurfaces::ZBuffer(buffer) => {
            bits = match buffer.bits {
                DepthBits::Sixteen => 16,
                DepthBits::TwentyFour => 24,
                DepthBits::ThirtyTwo => 32,
            };
            if buffer.source == DepthSource::PerSample {
                line("depth", "per-sample");
            }
        }
    }
    if bits < 32 {
        let _ = writeln!(text, "depth_bits = {bits}");
    }
    if scene.two_sided {
        text.push_str("two_sided = true\n");
    }
}
