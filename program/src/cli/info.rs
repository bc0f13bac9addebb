//! `fastphong info`: describes a scene or a mesh.

use super::input_name;
use super::mesh_facts::{MeshFacts, PLANAR};
use super::normal_text::describe;
use super::scene_flags::{Flags, SceneFlags};
use super::text::{counted, grouped, wrapped};
use super::{CliError, Log, Outcome, done, memory};
use fastphong::frame::Frame;
use fastphong::notes::{Cost, lies_on_its_side, of_frame, of_mesh};
use fastphong::raster::{Plan, Renderer};
use fastphong::scene::file::{SceneFile, shown};
use fastphong::scene::open::Look;
use fastphong::scene::{Projection, Scene};
use fastphong::shading::{METHODS, Variant};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Describe a scene or a mesh; a mesh without a scene as `compare` draws it, without the lights and
/// background that `render` adds
#[derive(clap::Args, Debug)]
pub struct InfoArgs {
    /// Scene file, mesh file, builtin:NAME?key=value, name of a shipped scene, or `-` for standard
    /// input
    #[arg(value_parser = input_name::parser())]
    input: String,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

/// The facts about an object: its mesh, and where its normals come from.
#[derive(serde::Serialize)]
struct ObjectFacts<'a> {
    mesh: &'a str,
    #[serde(flatten)]
    facts: MeshFacts,
    normals: String,
    /// Hints, for mesh files only: what may not look as intended, and which flag to try.
    hints: Vec<String>,
}

impl InfoArgs {
    /// Prints the facts.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let opened = self
            .scene
            .open_file(self.scene.read(&self.input)?, Look::Compared)?;
        log.notes(&opened.notes);
        let (file, scene) = (&opened.file, &opened.scene);
        // A mesh that several objects share is analysed once.
        let mut known = BTreeMap::new();
        let objects = scene.objects.iter().zip(file.meshes());
        let objects = objects.map(|(object, mesh)| {
            let of_mesh = || {
                let mut found = Vec::new();
                if !mesh.starts_with("builtin:") {
                    let lies = lies_on_its_side(&object.mesh);
                    let lies = lies.filter(|_| !self.scene.over().sets("camera.up"));
                    let hints = of_mesh(object);
                    let notes = lies.iter().chain(&hints).cloned();
                    found.extend(notes.map(|mut note| {
                        note.about.clear();
                        note.text(&Flags)
                    }));
                }
                (MeshFacts::of(&object.mesh), found)
            };
            let known = known.entry(Arc::as_ptr(&object.mesh));
            let (facts, hints) = known.or_insert_with(of_mesh).clone();
            let normals = describe(object);
            ObjectFacts {
                mesh,
                facts,
                normals,
                hints,
            }
        });
        let objects: Vec<ObjectFacts> = objects.collect();
        memory::check_frame(scene)?;
        let frame = scene.frame()?;
        let notes = of_frame(scene, &frame, Cost::Samples);
        let mut notes = notes.without_stated(|key| file.states(key));
        // This one is a row of the table.
        let too_bright = ["light/clamped", "light/endless-highlight"];
        let too_bright = notes
            .iter()
            .find(|note| too_bright.contains(&note.kind))
            .cloned();
        if let Some(note) = &too_bright {
            notes.remove(note.kind);
        }
        log.notes(&notes);
        let facts = SceneFacts {
            input: &self.input,
            file,
            scene,
            objects,
            choices: auto_choices(&frame),
            method: Variant::auto(&frame, Renderer::fastest()),
            too_bright: too_bright.map(|note| note.text(&Flags)),
        };
        done(&if self.json {
            format!("{:#}\n", facts.json())
        } else {
            facts.text()
        })
    }
}

/// The heading above the scene that the program makes for a mesh without one.
const WITHOUT_SCENE: &str = "as compared, without a scene file";

/// The facts about a scene: its file, its objects, and the methods chosen for it.
struct SceneFacts<'a> {
    input: &'a str,
    file: &'a SceneFile,
    scene: &'a Scene,
    objects: Vec<ObjectFacts<'a>>,
    choices: Vec<AutoChoice>,
    /// The method that `auto` chooses, and why.
    method: (Variant, &'static str),
    /// The warning that light is clamped.
    too_bright: Option<String>,
}

impl SceneFacts<'_> {
    /// Returns the description as JSON.
    fn json(&self) -> Value {
        let (scene, file, (method, why)) = (self.scene, self.file, &self.method);
        let camera = &scene.camera;
        let (half_height, fovy) = match camera.projection {
            Projection::Orthographic { half_height } => (Some(half_height), None),
            Projection::Perspective { fovy } => (None, Some(fovy)),
        };
        json!({
            "schema": "fastphong.info/1",
            "input": self.input,
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
            "auto": self.choices.iter().map(AutoChoice::json).collect::<Vec<_>>(),
            "too_bright": self.too_bright,
            "objects": self.objects,
        })
    }

    /// Returns the description as text.
    fn text(&self) -> String {
        let (input, scene, file, (method, why)) = (self.input, self.scene, self.file, &self.method);
        let title = file
            .title()
            .map_or_else(String::new, |title| format!(": {title}"));
        let description = wrapped(file.description().unwrap_or_default(), 2);
        let camera = &scene.camera;
        let projection = match camera.projection {
            Projection::Orthographic { half_height } => {
                let half_height = coordinate(half_height, half_height, 2);
                format!("orthographic, half height {half_height}")
            }
            Projection::Perspective { fovy } => format!("perspective, {fovy} degrees"),
        };
        let distance = (camera.eye - camera.target).length();
        let [eye, target] = [camera.eye, camera.target].map(|p| point(p.to_array(), distance));
        let (width, height, lights) = (scene.width, scene.height, scene.lights.len());
        let count = self.objects.len();
        let polygons = self.objects.iter().map(|o| o.facts.polygons).sum();
        let polygons = counted(polygons, "polygon", "polygons");
        let choices = self.choices.iter().map(AutoChoice::text);
        let choices = choices.collect::<Vec<_>>().join("\n           ");
        let bright = self.too_bright.as_ref();
        let bright = bright.map_or_else(String::new, |text| format!("\n  bright   {text}"));
        let facts = format!(
            "  picture  {width} x {height}
  camera   at {eye}, toward {target}; {projection}
  lights   {lights}
  objects  {count}, {polygons} in all{bright}
  method   {method} (chosen by auto: {why})
  auto     {choices}
"
        );
        let objects = self.objects.iter().map(ObjectFacts::text);
        match file.path() {
            // Without a scene file, the mesh comes first, then the scene that the program made for
            // it.
            None => {
                let objects: String = objects.collect();
                format!("{objects}\n{WITHOUT_SCENE}\n{facts}")
            }
            Some(_) => {
                let objects: String = objects.map(|object| format!("\n{object}")).collect();
                format!("{input}{title}\n{description}{facts}{objects}")
            }
        }
    }
}

/// Writes a point of something of size `extent`.
fn point(p: [f64; 3], extent: f64) -> String {
    let [x, y, z] = p.map(|value| coordinate(value, extent, 0));
    format!("({x}, {y}, {z})")
}

/// Writes a coordinate with enough decimals to show five digits of `extent`, but at least four, and
/// `more` beyond these. Uses an exponent if `extent` is tiny.
fn coordinate(value: f64, extent: f64, more: usize) -> String {
    if 0.0 < extent && extent < 1e-9 && value.abs() <= 1e3 * extent {
        return format!("{value:.*e}", 4 + more);
    }
    let decimals = match extent {
        0.0 => 4.0,
        _ => (4.0 - extent.log10().floor()).clamp(4.0, 17.0),
    };
    format!("{value:.*}", decimals as usize + more)
}

impl ObjectFacts<'_> {
    /// Returns the description of the object as text.
    fn text(&self) -> String {
        let facts = &self.facts;
        let sides = facts.polygons_by_sides.iter();
        let sides = sides.map(|(sides, count)| format!("{} of {sides} sides", grouped(*count)));
        let sides = sides.collect::<Vec<_>>().join(", ");
        let shared = "non-manifold (three polygons or more)";
        let odd = [
            (facts.open_edges, "open"),
            (facts.non_manifold_edges, shared),
            (facts.reversed_edges, "between polygons wound differently"),
        ];
        let odd = odd.iter().filter(|(count, _)| *count > 0);
        let odd = odd.map(|(count, kind)| format!("{} {kind}", grouped(*count)));
        let closed = if facts.closed {
            "closed".to_owned()
        } else {
            odd.collect::<Vec<_>>().join(", ")
        };
        let closed = match (facts.inside_out, facts.closed) {
            (0, _) => closed,
            (_, true) if facts.inside_out_polygons == facts.polygons => {
                format!("{closed}, wound inside out")
            }
            (n, _) => {
                let surfaces = counted(n, "surface is closed and", "surfaces are closed and");
                format!("{closed}; {surfaces} wound inside out")
            }
        };
        let materials = match (facts.materials, facts.polygons_without_material) {
            (0, _) => "none of its own".to_owned(),
            (n, 0) => n.to_string(),
            (n, without) => format!("{n}; {} polygons have none of them", grouped(without)),
        };
        let [polygons, degenerate, bent] =
            [facts.polygons, facts.degenerate, facts.not_planar].map(grouped);
        let [vertices, positions, edges] =
            [facts.vertices, facts.positions, facts.edges].map(grouped);
        let [concave, bytes] = [facts.concave, facts.bytes].map(grouped);
        let bounds = facts.bounds.map_or_else(String::new, |[low, high]| {
            let sides = [0, 1, 2].map(|axis| high[axis] - low[axis]);
            let extent = sides.into_iter().fold(0.0, f64::max);
            let [low, high] = [low, high].map(|p| point(p, extent));
            format!("\n  bounds      {low} to {high}")
        });
        let doubled = match facts.doubled {
            0 => String::new(),
            n => format!(
                "\n  doubled     {} with the corners of an earlier one",
                grouped(n)
            ),
        };
        let cancelling = match facts.cancelling {
            0 => String::new(),
            n => format!(", {} that cross themselves, their areas cancel", grouped(n)),
        };
        let colours = if facts.colours {
            "\n  colours     one for each position; --colours off leaves them out of the light"
        } else {
            ""
        };
        let hints = self
            .hints
            .iter()
            .map(|hint| format!("  hint        {hint}\n"));
        let hints: String = hints.collect();
        let (mesh, normals, share) = (shown(self.mesh), &self.normals, 100.0 * PLANAR);
        format!(
            "{mesh}
  polygons    {polygons}: {sides}
  degenerate  {degenerate} without area{cancelling}{doubled}
  concave     {concave}
  not planar  {bent} by more than {share} % of their extent
  vertices    {vertices} places, {positions} positions
  edges       {edges}: {closed}{bounds}
  materials   {materials}{colours}
  normals     {normals}
  memory      {bytes} bytes
{hints}"
        )
    }
}

/// An engine and instruction set that `auto` chooses, and the methods for which it does.
struct AutoChoice {
    plan: Plan,
    methods: Vec<&'static str>,
}

/// Returns the choices of `--engine auto --simd auto` on this machine without duplicates, in the
/// order of the methods.
fn auto_choices(frame: &Frame) -> Vec<AutoChoice> {
    let mut choices: Vec<AutoChoice> = Vec::new();
    for entry in METHODS {
        let plan = entry.variant().plan(frame, Renderer::fastest());
        let methods = vec![entry.info.name];
        match choices.iter_mut().find(|choice| choice.plan == plan) {
            Some(choice) => choice.methods.extend(methods),
            None => choices.push(AutoChoice { plan, methods }),
        }
    }
    choices
}

impl AutoChoice {
    /// Returns the choice in words.
    fn text(&self) -> String {
        let methods = self.methods.join(", ");
        let reason = self.plan.reason();
        let reason = reason.map_or(String::new(), |reason| format!(" ({reason})"));
        match self.plan.renderer() {
            Some(renderer) => {
                let (engine, level) = (renderer.engine().name(), renderer.level());
                format!("{engine}, {level}: {methods}{reason}")
            }
            None => format!("none: {methods}{reason}"),
        }
    }

    /// Returns the choice as JSON.
    fn json(&self) -> Value {
        let renderer = self.plan.renderer();
        let engine = renderer.map(|renderer| renderer.engine().name());
        let level = renderer.map(|renderer| renderer.level().name());
        let (reason, methods) = (self.plan.reason(), &self.methods);
        json!({ "engine": engine, "level": level, "reason": reason, "methods": methods })
    }
}
