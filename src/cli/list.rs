//! `fastphong list`: what there is, each from its own table.

use super::engines::{ENGINES, EngineInfo, engines_with};
use super::table::{columns, wrapped};
use super::talk::to_stdout;
use super::{Failure, Outcome};
use fastphong::compare::metrics::{METRICS, MetricInfo};
use fastphong::lectures::{FIGURES, Figure};
use fastphong::mesh::builtin::{BUILTINS, Builtin, ParameterKind, ShapeParameter};
use fastphong::number::Level;
use fastphong::scene::input::{SCENES, ShippedScene};
use fastphong::shading::{Info, METHODS, Roundings, Stepped};
use serde_json::{Value, json};

/// List methods, meshes, scenes, metrics, figures of the lectures, engines or instruction sets
#[derive(clap::Args, Debug)]
pub struct List {
    /// Things to list
    #[arg(value_enum)]
    subject: Subject,
    /// Print the list as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Subject {
    /// Shading methods
    Methods,
    /// Built-in meshes
    Meshes,
    /// Shipped scenes
    Scenes,
    /// Measures of the difference of two pictures
    Metrics,
    /// Figures of the lectures
    Figures,
    /// Engines that find the pixels
    Engines,
    /// Instruction sets of the pixel loops
    Simd,
}

impl List {
    /// Prints the list.
    pub fn run(&self) -> Result<Outcome, Failure> {
        let text = match (self.subject, self.json) {
            (Subject::Methods, false) => methods(),
            (Subject::Meshes, false) => meshes(),
            (Subject::Scenes, false) => scenes()?,
            (Subject::Metrics, false) => metrics(),
            (Subject::Figures, false) => figures(),
            (Subject::Engines, false) => engines(),
            (Subject::Simd, false) => simd(),
            (subject, true) => format!("{:#}\n", json(subject)?),
        };
        to_stdout(text.as_bytes())?;
        Ok(Outcome::Done)
    }
}

/// Returns the list as data.
fn json(subject: Subject) -> Result<Value, Failure> {
    Ok(match subject {
        Subject::Methods => METHODS
            .iter()
            .map(|entry| method_json(entry.info))
            .collect(),
        Subject::Meshes => BUILTINS.iter().map(mesh_json).collect(),
        Subject::Scenes => {
            let entry = |[name, title, description]: [String; 3]| json!({ "name": name, "title": title, "description": description });
            described()?.into_iter().map(entry).collect()
        }
        Subject::Metrics => {
            let entry = |metric: &MetricInfo| json!({ "name": metric.name, "unit": metric.unit, "better": word(metric.better), "meaning": metric.meaning });
            METRICS.iter().map(entry).collect()
        }
        Subject::Figures => {
            let entry = |figure: &&Figure| json!({ "name": figure.name, "title": figure.title, "lecture": figure.lecture });
            FIGURES.iter().map(entry).collect()
        }
        Subject::Engines => ENGINES.iter().map(EngineInfo::json).collect(),
        Subject::Simd => Level::ALL.into_iter().map(level_json).collect(),
    })
}

/// Returns the name of a variant in lower case.
fn word(variant: impl std::fmt::Debug) -> String {
    format!("{variant:?}").to_lowercase()
}

/// Lists the methods.
fn methods() -> String {
    let mut text = String::new();
    for entry in METHODS {
        let info = entry.info;
        let (perspective, positions) = (info.perspective.sentence(), info.local.sentence());
        text += &format!("{}\n    {}\n", info.name, info.title);
        text += &format!("    perspective: {perspective}\n    positions: {positions}\n");
        text += &format!(
            "    {}\n    engines: {}\n",
            exactness(info),
            engines_with(info)
        );
        for p in info.parameters {
            let (name, range, usual) = (p.name, p.range(), p.text(p.default));
            text += &format!("    {name}={range}, default {usual}: {}\n", p.meaning);
            if let Some(auto) = p.auto {
                text += &wrapped(&format!("{name}=auto: {}", auto.meaning), 4);
            }
        }
    }
    text
}

/// Says how near a method is to its closed form, in a sentence.
pub fn exactness(info: &Info) -> String {
    let Roundings { start, step, of } = info.roundings;
    let (model, of) = (info.model.name(), stepped(of));
    let text = format!("off its closed form, {model}, by {start} roundings of 2^-24 in its {of}");
    match step {
        0.0 => text,
        _ => format!("{text} and {step} more at every step"),
    }
}

fn stepped(of: Stepped) -> &'static str {
    match of {
        Stepped::Colours => "colours",
        Stepped::Sums => "unclamped colours",
        Stepped::Cosines => "cosines",
        Stepped::Products => "scalar products",
    }
}

/// Describes a method as data, without its texts of more than one line.
pub fn method_json(info: &Info) -> Value {
    let parameter = |p: &fastphong::shading::Parameter| {
        json!({
            "name": p.name, "meaning": p.meaning, "default": value_json(p, p.default),
            "least": p.least, "most": p.most, "auto": p.auto.map(|auto| auto.meaning),
        })
    };
    let Roundings { start, step, of } = info.roundings;
    let parameters: Vec<Value> = info.parameters.iter().map(parameter).collect();
    json!({
        "name": info.name,
        "title": info.title,
        "source": info.source,
        "model": info.model.name(),
        "roundings": { "start": start, "step": step, "of": stepped(of) },
        "perspective": info.perspective.sentence(),
        "local": info.local.sentence(),
        "barycentric": info.barycentric,
        "parameters": parameters,
    })
}

/// Returns the value of a parameter of a method: a number, or `"auto"`.
pub fn value_json(parameter: &fastphong::shading::Parameter, value: u32) -> Value {
    match parameter.is_auto(value) {
        true => "auto".into(),
        false => value.into(),
    }
}

/// Returns the default as it is written; `polygons` has none, as it stands for others.
fn default_text(parameter: &ShapeParameter) -> Option<Value> {
    match parameter.kind {
        _ if parameter.default < parameter.min => None,
        ParameterKind::Bool => Some(json!(parameter.default != 0.0)),
        ParameterKind::Integer => Some(json!(parameter.default as i64)),
        ParameterKind::Real => Some(json!(parameter.default)),
    }
}

/// Lists the built-in meshes.
fn meshes() -> String {
    let mut text = String::new();
    for shape in BUILTINS {
        text += &format!("builtin:{}\n    {}\n", shape.name, shape.doc);
        let rows = shape.all_parameters().map(|p| {
            let default = default_text(p).map_or(String::new(), |value| format!("default {value}"));
            let range = match p.kind {
                ParameterKind::Bool => "true, false".to_owned(),
                _ => format!("{} to {}", p.min, p.max),
            };
            [format!("    {}", p.name), range, default, p.doc.to_owned()]
        });
        text += &columns(&rows.collect::<Vec<_>>(), false, &[]);
    }
    text
}

fn mesh_json(shape: &Builtin) -> Value {
    let parameter = |p: &ShapeParameter| {
        json!({
            "name": p.name, "kind": word(p.kind), "default": default_text(p),
            "min": p.min, "max": p.max, "meaning": p.doc,
        })
    };
    let parameters: Vec<Value> = shape.all_parameters().map(parameter).collect();
    json!({ "name": shape.name, "meaning": shape.doc, "parameters": parameters })
}

/// Returns each shipped scene with its title and description.
fn described() -> Result<Vec<[String; 3]>, Failure> {
    let describe = |scene: &ShippedScene| {
        let file = scene.load()?;
        let text = |text: Option<&str>| text.unwrap_or_default().to_owned();
        Ok([
            scene.name.to_owned(),
            text(file.title()),
            text(file.description()),
        ])
    };
    SCENES.iter().map(describe).collect()
}

fn scenes() -> Result<String, Failure> {
    let mut text = String::new();
    for [name, title, description] in described()? {
        text += &format!("{name}\n    {title}\n{}", wrapped(&description, 4));
    }
    Ok(text)
}

fn metrics() -> String {
    let mut rows = vec![["metric", "unit", "better", "meaning"].map(str::to_owned)];
    rows.extend(METRICS.iter().map(|metric| {
        let better = word(metric.better);
        [metric.name, metric.unit, &better, metric.meaning].map(str::to_owned)
    }));
    columns(&rows, true, &[])
}

/// Lists the figures of the lectures.
fn figures() -> String {
    let entry = |figure: &&Figure| {
        let Figure {
            name,
            title,
            lecture,
            ..
        } = figure;
        format!("{name}\n    {title}\n    {lecture}\n")
    };
    FIGURES.iter().map(entry).collect()
}

/// Lists the engines.
fn engines() -> String {
    let entry = |engine: &EngineInfo| {
        let EngineInfo {
            name,
            title,
            draws,
            runs,
        } = engine;
        let methods = engine.methods().collect::<Vec<_>>().join(", ");
        let about = format!("{title}\ndraws: {draws}\non: {runs}\nmethods: {methods}");
        format!("{name}\n{}", wrapped(&about, 4))
    };
    ENGINES.iter().map(entry).collect()
}

fn simd() -> String {
    let rows = Level::ALL.map(|level| {
        let here = match level.is_available() {
            _ if level == Level::best() => "here, taken by auto",
            true => "here",
            false => "not on this machine",
        };
        [level.name(), here, level.title()].map(str::to_owned)
    });
    columns(&rows, false, &[])
}

fn level_json(level: Level) -> Value {
    json!({
        "name": level.name(), "title": level.title(), "width": level.width(),
        "available": level.is_available(), "auto": level == Level::best(),
    })
}
