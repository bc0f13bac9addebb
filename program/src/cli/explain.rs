//! `fastphong explain`: describes a method by its formula, cost, tolerance and weaknesses.

use super::engines::engines_with;
use super::list::{exactness, family, method_json};
use super::text::wrapped;
use super::{CliError, Outcome, done};
use crate::compare::comparison::parameter_json;
use crate::compare::table::Table;
use crate::report::{OPERATIONS, RATES};
use fastphong::scene::open::{Look, Overlay, open};
use fastphong::scene::{Falloff, Interpolation};
use fastphong::shading::{OperationCounts, SpanBench, Variant};
use serde_json::{Value, json};

/// Explain a shading method: formula, source, cost, tolerance, where it fails
#[derive(clap::Args, Debug)]
pub struct ExplainArgs {
    /// Method, with parameters as in `fast-phong:steps=1`
    #[arg(value_parser = Variant::parse)]
    method: Variant,
    /// Also show the operations for several lights, and for lights and eye at positions
    #[arg(long)]
    all: bool,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
}

/// The cases for which operations are counted: how many lights there are, and true if lights and
/// eye are at positions.
const CASES: [(usize, bool); 4] = [(1, false), (4, false), (1, true), (2, true)];

/// Makes the span for counting operations with lights and eye at positions. The angle between its
/// normals does not change the counts.
fn at_positions_span(lights: usize) -> SpanBench {
    SpanBench::local(20.0, lights, Falloff::None, Interpolation::Screen)
}

impl ExplainArgs {
    /// Prints the explanation.
    pub fn run(&self) -> Result<Outcome, CliError> {
        done(&if self.json {
            format!("{:#}\n", self.json()?)
        } else {
            self.text()?
        })
    }

    /// Explains the method in text.
    fn text(&self) -> Result<String, CliError> {
        let info = self.method.info();
        let mut text = format!("{}: {}\n", self.method, info.title);
        let mut section = |title: &str, body: &str| text += &format!("\n{title}\n{body}");
        // Formulas keep their lines.
        let formula = info.formula.lines().map(|line| format!("  {line}\n"));
        section("formula", &formula.collect::<String>());
        section("family", &wrapped(&family(info), 2));
        section("source", &wrapped(info.source, 2));
        let all = if self.all { CASES.len() } else { 1 };
        for (lights, at_positions) in self.cases().take(all) {
            let s = if lights == 1 { "" } else { "s" };
            let there = " and eye at positions";
            let eye = if at_positions { there } else { "" };
            let how = if self.method.row().is_integer {
                "spans and pixels read off their loops"
            } else {
                "as counted"
            };
            let title = format!("operations with {lights} light{s}{eye}, {how}");
            section(&title, &costs(&self.operations(lights, at_positions)));
        }
        if !info.claimed.is_empty() {
            section(
                "operations that the source states",
                &wrapped(info.claimed, 2),
            );
        }
        section("tolerance", &wrapped(&self.tolerance()?, 2));
        section("where it fails", &wrapped(info.fails, 2));
        section(
            "perspective",
            &wrapped(self.method.row().needs.perspective.sentence(), 2),
        );
        section(
            "lights at positions",
            &wrapped(self.method.row().needs.local.sentence(), 2),
        );
        let row = self.method.row();
        section("engines", &format!("  {}\n", engines_with(row)));
        if let Some(why) = row.scalar_only() {
            section("scalar only", &wrapped(why, 2));
        }
        if !row.kinds().is_empty() {
            section("kinds of polygons", &wrapped(&row.kinds().join(", "), 2));
        }
        let mut parameters = String::new();
        for (p, value) in info.parameters.iter().zip(self.method.parameters()) {
            let (value, default) = (p.text(*value), p.text(p.default));
            let (name, meaning, range) = (p.name, p.meaning, p.values());
            let text = format!("{name}={value}: {meaning}; {range}, default {default}");
            parameters += &wrapped(&text, 2);
            if let Some(auto) = p.auto {
                parameters += &wrapped(&format!("auto: {}", auto.meaning), 2);
            }
        }
        if parameters.is_empty() {
            parameters += "  none\n";
        }
        section("parameters", &parameters);
        Ok(text)
    }

    /// Returns the cases of [`CASES`] that the method can draw. Some methods need lights and eye at
    /// infinity.
    fn cases(&self) -> impl Iterator<Item = (usize, bool)> {
        let is_drawn = |(lights, at_positions): &(usize, bool)| {
            !at_positions || at_positions_span(*lights).refuses(&self.method).is_none()
        };
        CASES.into_iter().filter(is_drawn)
    }

    /// Counts the operations with `lights` lights. Lights at positions have no falloff, and
    /// varyings are linear on the screen.
    fn operations(&self, lights: usize, at_positions: bool) -> OperationCounts {
        if !at_positions {
            return self.method.operations(lights);
        }
        self.method.operations_on(&at_positions_span(lights))
    }

    fn tolerance(&self) -> Result<String, CliError> {
        let info = self.method.info();
        let (exactness, derivation) = (exactness(info), info.derivation);
        let levels = 255.0 * example_bound(&self.method)?;
        let example =
            format!("at most {levels:.3} grey levels on the scene `{EXAMPLE}` at 640x480");
        Ok(format!("{exactness}\n{derivation}\nfor example, {example}"))
    }

    /// Returns the explanation as JSON.
    fn json(&self) -> Result<Value, CliError> {
        let info = self.method.info();
        let mut json = method_json(self.method.row());
        let by_lights = |at_positions: bool| -> Value {
            let cases = self.cases().filter(|(_, there)| *there == at_positions);
            cases
                .map(|(n, there)| (n.to_string(), costs_json(&self.operations(n, there))))
                .collect()
        };
        json["variant"] = self.method.to_string().into();
        let values = info.parameters.iter().zip(self.method.parameters());
        json["values"] = values.map(|(p, value)| parameter_json(p, *value)).collect();
        json["formula"] = info.formula.into();
        json["derivation"] = info.derivation.into();
        json["fails"] = info.fails.into();
        json["example_bound"] = json!({ "scene": EXAMPLE, "bound": example_bound(&self.method)? });
        json["operations_by_lights"] = by_lights(false);
        json["operations_by_lights_at_positions"] = by_lights(true);
        Ok(json)
    }
}

/// The scene for the example of a bound.
const EXAMPLE: &str = "teapot";

fn example_bound(method: &Variant) -> Result<f64, CliError> {
    let opened = open(EXAMPLE, &Overlay::default(), Look::Compared)?;
    Ok(method.bound(&opened.scene.frame()?))
}

/// Returns counted operations as a table.
fn costs(counts: &OperationCounts) -> String {
    let mut table = Table::new("", &["  per"]);
    let names = OPERATIONS.iter().map(|(name, ..)| (*name).to_owned());
    table.head.extend(names);
    for (_, rate, of) in RATES {
        let counts = of(counts);
        // Dots instead of zeros make the other counts stand out.
        let cells = OPERATIONS.iter().map(|(.., of)| match of(&counts) {
            0 => ".".to_owned(),
            n => n.to_string(),
        });
        let row = std::iter::once(format!("  {rate}")).chain(cells);
        table.rows.push(row.collect());
    }
    table.text()
}

/// Returns counted operations as JSON.
fn costs_json(counts: &OperationCounts) -> Value {
    let rates = RATES.iter().map(|(_, rate, of)| {
        let (rate, counts) = (rate.replace(": ", "_").replace(' ', "_"), of(counts));
        let operations = OPERATIONS.iter().map(|(name, _, of)| (*name, of(&counts)));
        (rate, operations.collect::<Value>())
    });
    rates.collect()
}
