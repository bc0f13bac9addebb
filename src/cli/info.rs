//! `fastphong info`: what a scene or a mesh consists of.

use super::chosen::{Choice, choices};
use super::mesh_facts::{MeshFacts, PLANAR};
use super::scene_flags::SceneFlags;
use super::table::{columns, wrapped};
use super::talk::{Talk, grouped, json_to_stdout, to_stdout};
use super::{Failure, Outcome};
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::scene::file::SceneFile;
use fastphong::scene::{Object, Projection, Scene, input};
use glam::{DVec3, Vec3};
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
        let mut facts = |object: &Object| {
            let facts = seen
                .entry(Arc::as_ptr(&object.mesh))
                .or_insert_with(|| MeshFacts::of(&object.mesh));
            facts.clone()
        };
        let objects = scene.objects.iter().zip(file.meshes());
        let objects: Vec<Described> = objects
            .map(|(object, name)| Described {
                name,
                object,
                facts: facts(object),
            })
            .collect();
        let chosen = choices(&scene.frame()?);
        match self.json {
            true => json_to_stdout(&scene_json(&self.input, &file, scene, &objects, &chosen))?,
            false => {
                to_stdout(scene_text(&self.input, &file, scene, &objects, &chosen).as_bytes())?
            }
        }
        Ok(Outcome::Done)
    }
}

fn row(name: &str, value: impl Into<String>) -> Vec<String> {
    vec![format!("  {name}"), value.into()]
}

fn scene_text(
    input: &str,
    file: &SceneFile,
    scene: &Scene,
    objects: &[Described],
    chosen: &[Choice],
) -> String {
    let mut text = input.to_owned();
    if let Some(title) = file.title() {
        text += &format!(": {title}");
    }
    text.push('\n');
    if let Some(description) = file.description() {
        text += &wrapped(description, 2);
    }
    let camera = &scene.camera;
    let projection = match camera.projection {
        Projection::Orthographic { half_height } => {
            format!("orthographic, half height {half_height:.6}")
        }
        Projection::Perspective { fovy } => format!("perspective, {fovy} degrees"),
    };
    let total: usize = objects
        .iter()
        .map(|object| object.object.mesh.polygon_count())
        .sum();
    let mut rows = vec![
        row("picture", format!("{} x {}", scene.width, scene.height)),
        row(
            "camera",
            format!(
                "at {}, toward {}; {projection}",
                point(camera.eye),
                point(camera.target)
            ),
        ),
        row("lights", scene.lights.len().to_string()),
        row(
            "objects",
            format!("{}, {} polygons in all", objects.len(), grouped(total)),
        ),
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

fn point(p: DVec3) -> String {
    format!("({:.4}, {:.4}, {:.4})", p.x, p.y, p.z)
}

fn object_text(described: &Described) -> String {
    let facts = &described.facts;
    let sides: Vec<String> = facts
        .by_sides
        .iter()
        .map(|(sides, count)| format!("{} of {sides} sides", grouped(*count)))
        .collect();
    let edges = match facts.is_closed() {
        true => format!("{}: closed", grouped(facts.edges)),
        false => {
            let odd = [
                (facts.open_edges, "open"),
                (
                    facts.non_manifold_edges,
                    "non-manifold (three polygons or more)",
                ),
                (facts.reversed_edges, "between polygons wound differently"),
            ];
            let odd = odd
                .iter()
                .filter(|(count, _)| *count > 0)
                .map(|(count, what)| format!("{} {what}", grouped(*count)));
            format!(
                "{}: {}",
                grouped(facts.edges),
                odd.collect::<Vec<_>>().join(", ")
            )
        }
    };
    let materials = match (facts.materials, facts.without_material) {
        (0, _) => "none of its own".to_owned(),
        (n, 0) => n.to_string(),
        (n, without) => format!("{n}; {} polygons have none of them", grouped(without)),
    };
    let mut rows = vec![
        row(
            "polygons",
            format!(
                "{}: {}",
                grouped(described.object.mesh.polygon_count()),
                sides.join(", ")
            ),
        ),
        row(
            "degenerate",
            format!("{} without area", grouped(facts.degenerate)),
        ),
        row("concave", grouped(facts.concave)),
        row(
            "not planar",
            format!(
                "{} by more than {} % of their extent",
                grouped(facts.not_planar),
                100.0 * PLANAR
            ),
        ),
        row(
            "vertices",
            format!(
                "{} places, {} positions",
                grouped(facts.vertices),
                grouped(facts.positions)
            ),
        ),
        row("edges", edges),
    ];
    if let Some((low, high)) = facts.bounds {
        rows.push(row(
            "bounds",
            format!("{} to {}", point(low.as_dvec3()), point(high.as_dvec3())),
        ));
    }
    rows.push(row("materials", materials));
    rows.push(row("normals", normals(described)));
    rows.push(row("memory", format!("{} bytes", grouped(facts.bytes))));
    columns(&rows, false, &[])
}

/// Where the vertex normals of an object come from.
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

fn scene_json(
    input: &str,
    file: &SceneFile,
    scene: &Scene,
    objects: &[Described],
    chosen: &[Choice],
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
            "eye": camera.eye.to_array(),
            "target": camera.target.to_array(),
            "up": camera.up.to_array(),
            "half_height": half_height,
            "fovy": fovy,
            "near": camera.near,
            "far": camera.far,
        },
        "lights": scene.lights.len(),
        "auto": chosen.iter().map(Choice::json).collect::<Vec<_>>(),
        "objects": objects.iter().map(object_json).collect::<Vec<_>>(),
    })
}

fn object_json(described: &Described) -> Value {
    let facts = &described.facts;
    let by_sides: serde_json::Map<String, Value> = facts
        .by_sides
        .iter()
        .map(|(sides, count)| (sides.to_string(), json!(count)))
        .collect();
    let bounds = facts
        .bounds
        .map(|(low, high)| [low, high].map(|p: Vec3| p.as_dvec3().to_array()));
    json!({
        "mesh": described.name,
        "polygons": described.object.mesh.polygon_count(),
        "polygons_by_sides": by_sides,
        "degenerate": facts.degenerate,
        "concave": facts.concave,
        "not_planar": facts.not_planar,
        "vertices": facts.vertices,
        "positions": facts.positions,
        "bounds": bounds,
        "edges": facts.edges,
        "open_edges": facts.open_edges,
        "non_manifold_edges": facts.non_manifold_edges,
        "reversed_edges": facts.reversed_edges,
        "closed": facts.is_closed(),
        "materials": facts.materials,
        "polygons_without_material": facts.without_material,
        "given_normals": facts.given_normals,
        "normals": normals(described),
        "bytes": facts.bytes,
    })
}
