//! `fastphong list`: lists everything that has a name on the command line.

use super::engines::{ENGINES, EngineInfo, engines_with};
use super::text::wrapped;
use super::{CliError, Outcome, done};
use crate::compare::comparison::parameter_json;
use crate::compare::table::aligned;
use crate::diagnose::{MISTAKES, Mistake, scenes_that_show};
use crate::lectures::{FIGURES, Figure};
use fastphong::compare::metrics::METRICS;
use fastphong::mesh::builtin::{BUILTINS, Builtin, ParameterKind, ShapeParameter};
use fastphong::number::SimdLevel;
use fastphong::scene::input::{SCENES, ShippedScene};
use fastphong::shading::{Info, METHODS, MethodRow, Range, Stepped, Tier};
use serde_json::{Value, json};

/// List methods, meshes, scenes, metrics, figures of the lectures, engines, instruction sets or
/// mistakes
#[derive(clap::Args, Debug)]
pub struct ListArgs {
    /// What to list
    #[arg(value_enum)]
    subject: Subject,
    /// List all methods instead of the default ones
    #[arg(long)]
    all: bool,
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
    /// Metrics of the difference between two pictures
    Metrics,
    /// Figures of the lectures
    Figures,
    /// Engines that find the pixels
    Engines,
    /// Instruction sets of the pixel loops
    Simd,
    /// Mistakes that `diagnose` looks for
    Mistakes,
}

impl ListArgs {
    /// Prints the list.
    pub fn run(&self) -> Result<Outcome, CliError> {
        done(&if self.json {
            format!("{:#}\n", json(self.subject, self.all)?)
        } else {
            text(self.subject, self.all)?
        })
    }
}

/// Returns the list as text.
fn text(subject: Subject, all: bool) -> Result<String, CliError> {
    Ok(match subject {
        Subject::Methods => {
            let listed: String = listed(all).map(method_text).collect();
            let others = METHODS.len() - self::listed(all).count();
            match others {
                0 => listed,
                others => format!("{listed}{others} more: fastphong list methods --all\n"),
            }
        }
        Subject::Meshes => BUILTINS.iter().map(mesh_text).collect(),
        Subject::Scenes => scenes(|name, title, about| entry(name, &[title, about]))?,
        Subject::Metrics => {
            let mut rows = vec![["metric", "unit", "better", "meaning"].map(str::to_owned)];
            rows.extend(METRICS.iter().map(|metric| {
                let better = word(metric.better);
                [metric.name, metric.unit, &better, metric.meaning].map(str::to_owned)
            }));
            aligned(&rows, &[0, 1, 2, 3])
        }
        Subject::Figures => {
            let text = |figure: &&Figure| entry(figure.name, &[figure.title, figure.lecture]);
            FIGURES.iter().map(text).collect()
        }
        Subject::Engines => ENGINES.iter().map(engine_text).collect(),
        Subject::Mistakes => MISTAKES.iter().map(mistake_text).collect(),
        Subject::Simd => {
            let rows = SimdLevel::ALL.map(|level| {
                let here = match level.is_available() {
                    _ if level == SimdLevel::best() => "on this machine, chosen by auto",
                    true => "on this machine",
                    false => "not on this machine",
                };
                [level.name(), here, level.title()].map(str::to_owned)
            });
            aligned(&rows, &[0, 1, 2])
        }
    })
}

/// Returns the default methods, or all of them.
fn listed(all: bool) -> impl Iterator<Item = &'static MethodRow> {
    (METHODS.iter()).filter(move |entry| all || entry.info.tier == Tier::Default)
}

/// Returns the list as JSON.
fn json(subject: Subject, all: bool) -> Result<Value, CliError> {
    Ok(match subject {
        Subject::Methods => listed(all).map(method_json).collect(),
        Subject::Meshes => BUILTINS.iter().map(mesh_json).collect(),
        Subject::Scenes => scenes(
            |name, title, about| json!({ "name": name, "title": title, "description": about }),
        )?,
        Subject::Metrics => json!(METRICS),
        Subject::Figures => json!(FIGURES),
        Subject::Engines => ENGINES.iter().map(EngineInfo::json).collect(),
        Subject::Mistakes => MISTAKES.iter().map(mistake_json).collect(),
        Subject::Simd => SimdLevel::ALL.into_iter().map(level_json).collect(),
    })
}

/// Writes a name with indented paragraphs below it.
fn entry(name: &str, paragraphs: &[&str]) -> String {
    format!("{name}\n{}", wrapped(&paragraphs.join("\n"), 4))
}

/// Returns the name of an enum variant in lower case.
fn word(value: impl std::fmt::Debug) -> String {
    format!("{value:?}").to_lowercase()
}

fn method_text(method: &MethodRow) -> String {
    let info = method.info;
    let mut about = vec![
        info.title.to_owned(),
        family(info),
        format!("perspective: {}", method.needs.perspective.sentence()),
        format!("positions: {}", method.needs.local.sentence()),
        exactness(info),
        format!("engines: {}", engines_with(method)),
    ];
    for p in info.parameters {
        let (name, range, default) = (p.name, p.values(), p.text(p.default));
        about.push(format!("{name}={range}, default {default}: {}", p.meaning));
        about.extend(p.auto.map(|auto| format!("{name}=auto: {}", auto.meaning)));
    }
    entry(info.name, &[&about.join("\n")])
}

/// Returns the family, the tier and the catalogue numbers of a method: `quadratics, default, M10`.
pub fn family(info: &Info) -> String {
    let words = [info.family.name(), info.tier.name()];
    words
        .iter()
        .chain(info.ids)
        .copied()
        .collect::<Vec<_>>()
        .join(", ")
}

/// Returns a sentence on how near a method is to its closed form.
pub fn exactness(info: &Info) -> String {
    let (start, step) = (info.roundings.start, info.roundings.step);
    let (model, of) = (info.model.name(), stepped(info.roundings.of));
    let text = format!("error against the closed form `{model}`: {start} × 2^-24 in its {of}");
    match step {
        0.0 => text,
        _ => format!("{text}, and {step} × 2^-24 more at every step"),
    }
}

fn stepped(of: Stepped) -> &'static str {
    match of {
        Stepped::Colours => "colours",
        Stepped::Sums => "unclamped colours",
        Stepped::Cosines => "cosines",
        Stepped::GreatCircles => "cosines along great circles",
        Stepped::Products => "scalar products",
    }
}

/// Returns the ends of a parameter's range, or its words.
fn range_json(range: Range) -> Value {
    match range {
        Range::Whole(least, most) => json!([least, most]),
        Range::Decimal(least, most) => json!([least, most]),
        Range::Words(words) => json!(words),
    }
}

/// Returns the description of a method as JSON, without its texts of several lines.
pub fn method_json(method: &MethodRow) -> Value {
    let info = method.info;
    let parameters = info.parameters.iter().map(|p| {
        json!({
            "name": p.name, "meaning": p.meaning, "default": parameter_json(p, p.default),
            "range": range_json(p.range), "auto": p.auto.map(|auto| auto.meaning),
        })
    });
    let roundings = info.roundings;
    json!({
        "name": info.name,
        "title": info.title,
        "ids": info.ids,
        "family": info.family.name(),
        "tier": info.tier.name(),
        "integer": method.is_integer,
        "source": info.source,
        "claimed": info.claimed,
        "model": info.model.name(),
        "roundings": { "start": roundings.start, "step": roundings.step, "of": stepped(roundings.of) },
        "perspective": method.needs.perspective.sentence(),
        "local": method.needs.local.sentence(),
        "barycentric": method.is_barycentric(),
        "parameters": parameters.collect::<Value>(),
    })
}

/// Returns the default of a mesh parameter. `polygons` has none, because it sets other parameters.
fn default_json(parameter: &ShapeParameter) -> Option<Value> {
    match parameter.kind {
        _ if parameter.default < parameter.min => None,
        ParameterKind::Bool => Some(json!(parameter.default != 0.0)),
        ParameterKind::Integer => Some(json!(parameter.default as i64)),
        ParameterKind::Real => Some(json!(parameter.default)),
    }
}

fn mesh_text(shape: &Builtin) -> String {
    let rows = shape.all_parameters().map(|p| {
        let default = default_json(p).map_or(String::new(), |value| format!("default {value}"));
        let range = match p.kind {
            ParameterKind::Bool => "true, false".to_owned(),
            _ => format!("{} to {}", p.min, p.max),
        };
        [format!("    {}", p.name), range, default, p.doc.to_owned()]
    });
    let rows = aligned(&rows.collect::<Vec<_>>(), &[0, 1, 2, 3]);
    entry(&format!("builtin:{}", shape.name), &[shape.doc]) + &rows
}

fn mesh_json(shape: &Builtin) -> Value {
    let parameters = shape.all_parameters().map(|p| {
        json!({
            "name": p.name, "kind": word(p.kind), "default": default_json(p),
            "min": p.min, "max": p.max, "meaning": p.doc,
        })
    });
    let parameters: Value = parameters.collect();
    json!({ "name": shape.name, "meaning": shape.doc, "parameters": parameters })
}

/// Calls `describe` with the name, title and description of each shipped scene.
fn scenes<T, List: FromIterator<T>>(
    describe: impl Fn(&str, &str, &str) -> T,
) -> Result<List, CliError> {
    let describe = |scene: &ShippedScene| {
        let file = scene.load()?;
        let [title, description] =
            [file.title(), file.description()].map(Option::unwrap_or_default);
        Ok(describe(scene.name, title, description))
    };
    SCENES.iter().map(describe).collect()
}

fn engine_text(engine: &EngineInfo) -> String {
    let (draws, runs) = (engine.draws, engine.runs);
    let methods = engine.methods().collect::<Vec<_>>().join(", ");
    let facts = format!("draws: {draws}\non: {runs}\nmethods: {methods}");
    entry(engine.name, &[engine.title, &facts])
}

fn level_json(level: SimdLevel) -> Value {
    json!({
        "name": level.name(), "title": level.title(), "width": level.width(),
        "available": level.is_available(), "auto": level == SimdLevel::best(),
    })
}

fn mistake_text(mistake: &Mistake) -> String {
    let shown = scenes_that_show(&mistake.id);
    let by = |(scene, levels): &(&str, f32)| format!("{scene} {levels:.1}");
    let scenes: Vec<String> = shown.iter().take(4).map(by).collect();
    let shown = if scenes.is_empty() {
        "shown by no shipped scene".to_owned()
    } else {
        format!("shown by, in grey levels: {}", scenes.join(", "))
    };
    let part = format!("part: {}", word(mistake.part));
    let fix = format!("what to do: {}", mistake.fix);
    let read = format!("read on: {}", mistake.read_on());
    entry(&mistake.id, &[&mistake.text, &part, &fix, &read, &shown])
}

fn mistake_json(mistake: &Mistake) -> Value {
    let shown = scenes_that_show(&mistake.id);
    let shown = shown
        .iter()
        .map(|(scene, levels)| json!({ "scene": scene, "levels": levels }));
    json!({
        "id": mistake.id, "part": word(mistake.part), "text": mistake.text, "fix": mistake.fix,
        "see": mistake.see, "shown_by": shown.collect::<Value>(),
    })
}
