//! `fastphong info`: what a scene or a mesh consists of.

use super::chosen::{Choice, choices};
use super::mesh_facts::{MeshFacts, PLANAR};
use super::scene_flags::SceneFlags;
use super::table::{columns, wrapped};
use super::talk::{Talk, grouped, json_to_stdout, to_stdout};
use super::{Failure, Outcome};
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::raster::Renderer;
use fastphong::scene::file::SceneFile;
use fastphong::scene::{Object, Projection, Scene, input};
use fastphong::shading::Variant;
use glam::DVec3;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Say what a scene or a mesh consists of
#[derive(clap::Args, Debug)]
pub struct Info {
    /// A scene file, a mesh file, builtin:NAME?key=value, or the name of a shipped scene
    input: String,
    /// Print all as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

/// An object, the name of its mesh, and what was found out about that.
struct Described<'a> {
    name: &'a str,
    object: &'a Object,
    facts: MeshFacts,
}

impl Info {
    /// Prints what there is.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let file = self.scene.load(&self.input)?;
        let resolved = input::resolve(&file)?;
        self.scene.warn(&resolved, *talk);
        let scene = &resolved.scene;
        // A mesh that several objects share is looked at once.
        let mut seen = BTreeMap::new();
        let mut facts = |Object { mesh, .. }: &Object| {
            let facts = seen.entry(Arc::as_ptr(mesh));
            facts.or_insert_with(|| MeshFacts::of(mesh)).clone()
        };
        let objects = scene.objects.iter().zip(file.meshes());
        let objects: Vec<Described> = objects
            .map(|(object, name)| Described {
                name,
                object,
                facts: facts(object),
            })
            .collect();
        let frame = scene.frame()?;
        let chosen = choices(&frame);
        let method = Variant::auto(&frame, Renderer::fastest());
        let input = &self.input;
        match self.json {
            true => json_to_stdout(&scene_json(input, &file, scene, &objects, &chosen, &method)),
            false => {
                to_stdout(scene_text(input, &file, scene, &objects, &chosen, &method).as_bytes())
            }
        }?;
        Ok(Outcome::Done)
    }
}

fn row(name: &str, value: impl Into<String>) -> [String; 2] {
    [format!("  {name}"), value.into()]
}

/// Describes a scene in text.
fn scene_text(
    input: &str,
    file: &SceneFile,
    scene: &Scene,
    objects: &[Described],
    chosen: &[Choice],
    (method, why): &(Variant, &str),
) -> String {
    let mut text = match file.title() {
        Some(title) => format!("{input}: {title}\n"),
        None => format!("{input}\n"),
    };
    text += &wrapped(file.description().unwrap_or_default(), 2);
    let camera = &scene.camera;
    let projection = match camera.projection {
        Projection::Orthographic { half_height } => {
            format!("orthographic, half height {half_height:.6}")
        }
        Projection::Perspective { fovy } => format!("perspective, {fovy} degrees"),
    };
    let (eye, target) = (point(camera.eye), point(camera.target));
    let polygons = objects.iter().map(|o| o.object.mesh.polygon_count());
    let (count, polygons) = (objects.len(), grouped(polygons.sum()));
    let mut rows = vec![
        row("picture", format!("{} x {}", scene.width, scene.height)),
        row("camera", format!("at {eye}, toward {target}; {projection}")),
        row("lights", scene.lights.len().to_string()),
        row("objects", format!("{count}, {polygons} polygons in all")),
        row("method", format!("{method} by auto: {why}")),
    ];
    for (number, choice) in chosen.iter().enumerate() {
        rows.push(row(if number == 0 { "auto" } else { "" }, choice.text()));
    }
    text += &columns(&rows, false, &[]);
    for object in objects {
        text += &format!("\n{}\n{}", object.name, object_text(object));
    }
    text
}

fn point(p: impl Into<DVec3>) -> String {
    let p = p.into();
    format!("({:.4}, {:.4}, {:.4})", p.x, p.y, p.z)
}

/// Describes an object in text.
fn object_text(described: &Described) -> String {
    let facts = &described.facts;
    let polygons = grouped(described.object.mesh.polygon_count());
    let sides = facts.polygons_by_sides.iter();
    let sides = sides.map(|(sides, count)| format!("{} of {sides} sides", grouped(*count)));
    let sides = sides.collect::<Vec<_>>().join(", ");
    let odd = [
        (facts.open_edges, "open"),
        (
            facts.non_manifold_edges,
            "non-manifold (three polygons or more)",
        ),
        (facts.reversed_edges, "between polygons wound differently"),
    ];
    let odd = odd.iter().filter(|(count, _)| *count > 0);
    let odd: Vec<String> = odd
        .map(|(count, what)| format!("{} {what}", grouped(*count)))
        .collect();
    let closed = if facts.is_closed() {
        "closed"
    } else {
        &odd.join(", ")
    };
    let materials = match (facts.materials, facts.polygons_without_material) {
        (0, _) => "none of its own".to_owned(),
        (n, 0) => n.to_string(),
        (n, without) => format!("{n}; {} polygons have none of them", grouped(without)),
    };
    let [degenerate, concave, bent] =
        [facts.degenerate, facts.concave, facts.not_planar].map(grouped);
    let [vertices, positions, edges, bytes] =
        [facts.vertices, facts.positions, facts.edges, facts.bytes].map(grouped);
    let share = 100.0 * PLANAR;
    let mut rows = vec![
        row("polygons", format!("{polygons}: {sides}")),
        row("degenerate", format!("{degenerate} without area")),
        row("concave", concave),
        row(
            "not planar",
            format!("{bent} by more than {share} % of their extent"),
        ),
        row(
            "vertices",
            format!("{vertices} places, {positions} positions"),
        ),
        row("edges", format!("{edges}: {closed}")),
    ];
    if let Some([low, high]) = facts.bounds {
        rows.push(row("bounds", format!("{} to {}", point(low), point(high))));
    }
    rows.push(row("materials", materials));
    rows.push(row("normals", normals(described)));
    rows.push(row("memory", format!("{bytes} bytes")));
    columns(&rows, false, &[])
}

/// Says where the vertex normals of an object come from.
fn normals(described: &Described) -> String {
    match (described.object.normals, described.facts.given_normals) {
        (NormalSource::Given, true) => "given with the mesh".to_owned(),
        (NormalSource::Given, false) => "averaged: the mesh has none".to_owned(),
        (NormalSource::Averaged, _) => "averaged".to_owned(),
        (NormalSource::Crease(degrees), _) => {
            format!("averaged up to a crease of {degrees} degrees")
        }
    }
}

/// Describes a scene as data.
fn scene_json(
    input: &str,
    file: &SceneFile,
    scene: &Scene,
    objects: &[Described],
    chosen: &[Choice],
    (method, why): &(Variant, &str),
) -> Value {
    let camera = &scene.camera;
    let (half_height, fovy) = match camera.projection {
        Projection::Orthographic { half_height } => (Some(half_height), None),
        Projection::Perspective { fovy } => (None, Some(fovy)),
    };
    json!({
        "schema": "fastphong.info/1",
        "input": input,
        "title": file.title(),
        "description": file.description(),
        "width": scene.width,
        "height": scene.height,
        "camera": {
            "eye": camera.eye.to_array(), "target": camera.target.to_array(), "up": camera.up.to_array(),
            "half_height": half_height, "fovy": fovy, "near": camera.near, "far": camera.far,
        },
        "lights": scene.lights.len(),
        "method": { "name": method.to_string(), "reason": why },
        "auto": chosen.iter().map(Choice::json).collect::<Vec<_>>(),
        "objects": objects.iter().map(object_json).collect::<Vec<_>>(),
    })
}

fn object_json(described: &Described) -> Value {
    let mut json = json!(described.facts);
    json["mesh"] = described.name.into();
    json["polygons"] = described.object.mesh.polygon_count().into();
    json["closed"] = described.facts.is_closed().into();
    json["normals"] = normals(described).into();
    json
}
