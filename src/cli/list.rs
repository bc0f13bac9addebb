//! `fastphong list`: what there is, each from its own table.

use super::engines::{ENGINES, EngineInfo, engines_with};
use super::table::{columns, wrapped};
use super::talk::{json_to_stdout, to_stdout};
use super::{Failure, Outcome};
use fastphong::compare::metrics::{Better, METRICS};
use fastphong::lectures::FIGURES;
use fastphong::mesh::builtin::{BUILTINS, Kind, Parameter};
use fastphong::number::Level;
use fastphong::scene::input::{SCENES, ShippedScene};
use fastphong::shading::{Info, METHODS, Roundings, Stepped};
use serde_json::{Value, json};

/// List methods, meshes, scenes, metrics, figures of the lectures, engines or instruction sets
#[derive(clap::Args, Debug)]
pub struct List {
    /// What to list
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
    /// What finds the pixels
    Engines,
    /// Instruction sets of the pixel loops
    Simd,
}

impl List {
    /// Prints the list.
    pub fn run(&self) -> Result<Outcome, Failure> {
        if self.json {
            let entries: Vec<Value> = match self.subject {
                Subject::Methods => METHODS
                    .iter()
                    .map(|entry| method_json(entry.info))
                    .collect(),
                Subject::Meshes => meshes_json(),
                Subject::Scenes => scenes_json()?,
                Subject::Metrics => metrics_json(),
                Subject::Figures => figures_json(),
                Subject::Engines => ENGINES.iter().map(EngineInfo::json).collect(),
                Subject::Simd => simd_json(),
            };
            json_to_stdout(&entries.into())?;
        } else {
            let text = match self.subject {
                Subject::Methods => methods(),
                Subject::Meshes => meshes(),
                Subject::Scenes => scenes()?,
                Subject::Metrics => metrics(),
                Subject::Figures => figures(),
                Subject::Engines => engines(),
                Subject::Simd => simd(),
            };
            to_stdout(text.as_bytes())?;
        }
        Ok(Outcome::Done)
    }
}

fn methods() -> String {
    let mut text = String::new();
    for entry in METHODS {
        let info = entry.info;
        text += &format!("{}\n    {}\n", info.name, info.title);
        text += &format!("    perspective: {}\n", info.perspective.sentence());
        text += &format!("    positions: {}\n", info.local.sentence());
        text += &format!("    {}\n", exactness(info));
        text += &format!("    engines: {}\n", engines_with(info));
        for p in info.parameters {
            text += &format!(
                "    {}={}, default {}: {}\n",
                p.name,
                p.range(),
                p.text(p.default),
                p.meaning
            );
            if let Some(auto) = p.auto {
                text += &wrapped(&format!("{}=auto: {}", p.name, auto.meaning), 4);
            }
        }
    }
    text
}

/// How near a method is to its closed form, in a sentence.
pub fn exactness(info: &Info) -> String {
    let Roundings { start, step, of } = info.roundings;
    let model = info.model.name();
    match step {
        0.0 => format!(
            "off its closed form, {model}, by {start} roundings of 2^-24 in its {}",
            stepped(of)
        ),
        _ => format!(
            "off its closed form, {model}, by {start} roundings of 2^-24 in its {} and {step} more at every step",
            stepped(of)
        ),
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

/// What is said about a method, without its texts of more than one line.
pub fn method_json(info: &Info) -> Value {
    let parameter = |p: &fastphong::shading::Parameter| json!({ "name": p.name, "meaning": p.meaning, "default": value_json(p, p.default), "least": p.least, "most": p.most, "auto": p.auto.map(|auto| auto.meaning) });
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

/// The value of a parameter of a method: a number, or `"auto"`.
pub fn value_json(parameter: &fastphong::shading::Parameter, value: u32) -> Value {
    if parameter.is_auto(value) {
        "auto".into()
    } else {
        value.into()
    }
}

fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Integer => "integer",
        Kind::Real => "real",
        Kind::Bool => "bool",
    }
}

/// The default as it is written; `polygons` has none, as it stands for others.
fn default_text(parameter: &Parameter) -> Option<Value> {
    match parameter.kind {
        _ if parameter.default < parameter.min => None,
        Kind::Bool => Some(json!(parameter.default != 0.0)),
        Kind::Integer => Some(json!(parameter.default as i64)),
        Kind::Real => Some(json!(parameter.default)),
    }
}

fn meshes() -> String {
    let mut text = String::new();
    for shape in BUILTINS {
        text += &format!("builtin:{}\n    {}\n", shape.name, shape.doc);
        let rows = shape.all_parameters().map(|p| {
            let default = default_text(p).map_or(String::new(), |value| format!("default {value}"));
            let range = if p.kind == Kind::Bool {
                "true, false".to_owned()
            } else {
                format!("{} to {}", p.min, p.max)
            };
            vec![format!("    {}", p.name), range, default, p.doc.to_owned()]
        });
        text += &columns(&rows.collect::<Vec<_>>(), false, &[]);
    }
    text
}

fn meshes_json() -> Vec<Value> {
    let shape = |shape: &fastphong::mesh::builtin::Builtin| {
        let parameters: Vec<Value> = shape
            .all_parameters()
            .map(|p| {
                json!({
                    "name": p.name,
                    "kind": kind(p.kind),
                    "default": default_text(p),
                    "min": p.min,
                    "max": p.max,
                    "meaning": p.doc,
                })
            })
            .collect();
        json!({ "name": shape.name, "meaning": shape.doc, "parameters": parameters })
    };
    BUILTINS.iter().map(shape).collect()
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

fn scenes_json() -> Result<Vec<Value>, Failure> {
    let entry = |[name, title, description]: [String; 3]| json!({ "name": name, "title": title, "description": description });
    Ok(described()?.into_iter().map(entry).collect())
}

fn better(better: Better) -> &'static str {
    match better {
        Better::Lower => "lower",
        Better::Higher => "higher",
        Better::Zero => "zero",
    }
}

fn metrics() -> String {
    let mut rows = vec![
        ["metric", "unit", "better", "meaning"]
            .map(str::to_owned)
            .to_vec(),
    ];
    rows.extend(METRICS.iter().map(|metric| {
        [
            metric.name,
            metric.unit,
            better(metric.better),
            metric.meaning,
        ]
        .map(str::to_owned)
        .to_vec()
    }));
    columns(&rows, true, &[])
}

fn metrics_json() -> Vec<Value> {
    let entry = |metric: &fastphong::compare::metrics::MetricInfo| json!({ "name": metric.name, "unit": metric.unit, "better": better(metric.better), "meaning": metric.meaning });
    METRICS.iter().map(entry).collect()
}

fn figures() -> String {
    FIGURES
        .iter()
        .map(|figure| {
            format!(
                "{}\n    {}\n    {}\n",
                figure.name, figure.title, figure.lecture
            )
        })
        .collect()
}

fn figures_json() -> Vec<Value> {
    let entry = |figure: &&fastphong::lectures::Figure| json!({ "name": figure.name, "title": figure.title, "lecture": figure.lecture });
    FIGURES.iter().map(entry).collect()
}

fn engines() -> String {
    let mut text = String::new();
    for engine in &ENGINES {
        let EngineInfo {
            name,
            title,
            draws,
            runs,
        } = engine;
        let methods = engine.methods().collect::<Vec<_>>().join(", ");
        let about = wrapped(
            &format!("{title}\ndraws: {draws}\non: {runs}\nmethods: {methods}"),
            4,
        );
        text += &format!("{name}\n{about}");
    }
    text
}

fn simd() -> String {
    let rows = Level::ALL.map(|level| {
        let here = match () {
            () if level == Level::best() => "here, taken by auto",
            () if level.is_available() => "here",
            () => "not on this machine",
        };
        [level.name(), here, level.title()]
            .map(str::to_owned)
            .to_vec()
    });
    columns(&rows, false, &[])
}

fn simd_json() -> Vec<Value> {
    let entry = |level: Level| {
        json!({
            "name": level.name(),
            "title": level.title(),
            "width": level.width(),
            "available": level.is_available(),
            "auto": level == Level::best(),
        })
    };
    Level::ALL.map(entry).to_vec()
}
