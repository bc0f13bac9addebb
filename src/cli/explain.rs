//! `fastphong explain`: all that is said about one method, and what it costs.

use super::engines::engines_with;
use super::list::{exactness, method_json, value_json};
use super::table::{columns, wrapped};
use super::talk::{json_to_stdout, to_stdout};
use super::{Failure, Outcome};
use fastphong::number::Counts;
use fastphong::scene::{Falloff, Interpolation, input};
use fastphong::shading::{OperationCounts, SpanBench, Variant};
use serde_json::{Map, Value, json};

/// Explain a shading method: formula, source, cost, tolerance, where it fails
#[derive(clap::Args, Debug)]
pub struct Explain {
    /// The method, with parameters as in `fast-phong:steps=1`
    #[arg(value_parser = Variant::parse)]
    method: Variant,
    /// Print all as JSON
    #[arg(long)]
    json: bool,
}

/// The numbers of lights that operations are counted for.
const LIGHTS: [usize; 2] = [1, 4];

/// The numbers of lights at positions that operations are counted for, the eye being at one, too.
const LIGHTS_AT_POSITIONS: [usize; 2] = [1, 2];

/// A rate at which something is computed, and a function that takes it from the counts.
type Rate = (&'static str, fn(&OperationCounts) -> Counts);

const RATES: [Rate; 7] = [
    ("vertex", |c| c.vertex),
    ("polygon", |c| c.polygon),
    ("edge", |c| c.edge),
    ("edge step", |c| c.edge_step),
    ("span", |c| c.span),
    ("pixel: walk", |c| c.walk),
    ("pixel: shade", |c| c.shade),
];

/// A kind of operation, and a function that takes it from the counts.
type Kind = (&'static str, fn(&Counts) -> u32);

const KINDS: [Kind; 7] = [
    ("add", |c| c.additions),
    ("mul", |c| c.multiplications),
    ("div", |c| c.divisions),
    ("root", |c| c.roots),
    ("compare", |c| c.comparisons),
    ("trig", |c| c.trigonometric),
    ("power", |c| c.powers),
];

impl Explain {
    /// Prints the explanation.
    pub fn run(&self) -> Result<Outcome, Failure> {
        if self.json {
            json_to_stdout(&self.json()?)?
        } else {
            to_stdout(self.text()?.as_bytes())?
        }
        Ok(Outcome::Done)
    }

    /// Explains the method in text.
    fn text(&self) -> Result<String, Failure> {
        let info = self.method.info();
        let mut text = format!("{}: {}\n", self.method, info.title);
        let mut section = |title: &str, body: &str| text += &format!("\n{title}\n{body}");
        // Formulas keep their lines.
        let formula = info.formula.lines().map(|line| format!("  {line}\n"));
        section("formula", &formula.collect::<String>());
        section("source", &wrapped(info.source, 2));
        for lights in LIGHTS {
            let s = if lights == 1 { "" } else { "s" };
            let title = format!("operations with {lights} light{s}, as counted");
            section(&title, &costs(&self.method.operations(lights)));
        }
        for lights in LIGHTS_AT_POSITIONS {
            let s = if lights == 1 { "" } else { "s" };
            let title =
                format!("operations with {lights} light{s} and eye at positions, as counted");
            section(&title, &costs(&self.near(lights)));
        }
        section("tolerance", &wrapped(&self.tolerance()?, 2));
        section("where it fails", &wrapped(info.fails, 2));
        section("perspective", &wrapped(info.perspective.sentence(), 2));
        section("lights at positions", &wrapped(info.local.sentence(), 2));
        section("engines", &format!("  {}\n", engines_with(info)));
        let mut parameters = String::new();
        for (p, value) in info.parameters.iter().zip(self.method.parameters()) {
            let (value, usual) = (p.text(*value), p.text(p.default));
            let mut text = format!(
                "{}={value}: {}; {}, default {usual}",
                p.name,
                p.meaning,
                p.range()
            );
            if let Some(auto) = p.auto {
                text += &format!("\nauto: {}", auto.meaning);
            }
            parameters += &wrapped(&text, 2);
        }
        if parameters.is_empty() {
            parameters += "  none\n";
        }
        section("parameters", &parameters);
        Ok(text)
    }

    /// Counts the operations with `lights` lights and the eye at positions, no falloff, attributes linear on the screen.
    fn near(&self, lights: usize) -> OperationCounts {
        // The angle of the span's normals is not counted: any will do.
        let span = SpanBench::local(20.0, lights, Falloff::None, Interpolation::Screen);
        self.method.operations_on(&span)
    }

    fn tolerance(&self) -> Result<String, Failure> {
        let info = self.method.info();
        let levels = 255.0 * example_bound(&self.method)?;
        let example =
            format!("at most {levels:.3} grey levels on the scene `{EXAMPLE}` at 640x480");
        Ok(format!(
            "{}\n{}\nfor example, {example}",
            exactness(info),
            info.derivation
        ))
    }

    /// Returns the explanation as data.
    fn json(&self) -> Result<Value, Failure> {
        let info = self.method.info();
        let mut json = method_json(info);
        let by_lights = |lights: &[usize], of: &dyn Fn(usize) -> OperationCounts| -> Value {
            let costs = lights.iter().map(|&n| (n.to_string(), costs_json(&of(n))));
            costs.collect::<Map<String, Value>>().into()
        };
        json["variant"] = self.method.to_string().into();
        let values = info.parameters.iter().zip(self.method.parameters());
        json["values"] = values.map(|(p, value)| value_json(p, *value)).collect();
        json["formula"] = info.formula.into();
        json["model"] = info.model.name().into();
        json["derivation"] = info.derivation.into();
        json["fails"] = info.fails.into();
        json["example_bound"] = json!({ "scene": EXAMPLE, "bound": example_bound(&self.method)? });
        json["operations_by_lights"] = by_lights(&LIGHTS, &|lights| self.method.operations(lights));
        json["operations_by_lights_at_positions"] =
            by_lights(&LIGHTS_AT_POSITIONS, &|lights| self.near(lights));
        Ok(json)
    }
}

/// The scene on which a bound is given as an example.
const EXAMPLE: &str = "teapot";

fn example_bound(method: &Variant) -> Result<f64, Failure> {
    let frame = input::resolve(&input::load(EXAMPLE)?)?.scene.frame()?;
    Ok(method.bound(&frame))
}

/// Returns counted operations as a table.
fn costs(counts: &OperationCounts) -> String {
    let cells = |first: String, kind: &dyn Fn(&Kind) -> String| {
        let [a, b, c, d, e, f, g] = KINDS.each_ref().map(kind);
        [first, a, b, c, d, e, f, g]
    };
    let mut rows = vec![cells("  once a".to_owned(), &|(name, _)| {
        (*name).to_owned()
    })];
    rows.extend(RATES.map(|(rate, of)| {
        let counts = of(counts);
        // A zero says less than nothing: the operations that are done stand out.
        cells(format!("  {rate}"), &|(_, kind)| match kind(&counts) {
            0 => ".".to_owned(),
            n => n.to_string(),
        })
    }));
    columns(&rows, false, &[1, 2, 3, 4, 5, 6, 7])
}

/// Returns counted operations as data.
fn costs_json(counts: &OperationCounts) -> Value {
    let kinds = |counts: Counts| -> Map<String, Value> {
        let kinds = KINDS
            .iter()
            .map(|(name, kind)| (name.to_string(), json!(kind(&counts))));
        kinds.collect()
    };
    let rates = RATES.iter().map(|(name, of)| {
        let name = name.replace(": ", "_").replace(' ', "_");
        (name, kinds(of(counts)).into())
    });
    rates.collect::<Map<String, Value>>().into()
}
