//! `fastphong bench --spans`: times single spans of rising length, shaded by the methods' scalar
//! loops without an engine, set-up included.

use super::CliError;
use super::Log;
use super::measured::command_line;
use super::progress::Progress;
use crate::compare::table::Table;
use crate::compare::timing::{Candidate, Clock, Machine, Noise, TimeLimits, time_interleaved};
use fastphong::shading::{SpanBench, Variant};
use serde::Serialize;
use std::hint::black_box;
use std::time::Duration;

/// The schema of the data: see `docs/bench-json.md`.
const SCHEMA: &str = "fastphong.spans/2";

/// Degrees between the normals at the ends of a span.
const DEGREES: f32 = 20.0;
/// The lengths of the spans, in pixels.
const LENGTHS: [usize; 11] = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024];
/// How many rounds there are. In each, every method shades a span of every length twice.
const ROUNDS: usize = 8;

/// The times of a method with a number of lights.
#[derive(Clone, Debug, Serialize)]
struct SpanTimes {
    method: String,
    lights: usize,
    /// Nanoseconds per span, for each length.
    ns: Vec<f64>,
}

/// The data, with its fields in the order of `docs/bench-json.md`.
#[derive(Serialize)]
struct Document<'a> {
    schema: &'static str,
    command_line: Vec<String>,
    machine: Machine,
    degrees: f32,
    lengths: [usize; LENGTHS.len()],
    noise: Noise,
    spans: &'a [SpanTimes],
}

/// Times spans with one light and with four; returns the times as text and as JSON.
pub fn span_times(methods: &[Variant], log: Log) -> Result<(String, String), CliError> {
    let progress = Progress::silent_between_moves(log);
    let benches = [1, 4].map(|lights| (lights, SpanBench::new(DEGREES, lights)));
    let mut all = Vec::new();
    let mut spans: Vec<Candidate<'_>> = Vec::new();
    for (lights, bench) in &benches {
        for variant in methods {
            if let Some(reason) = bench.refuses(variant) {
                if *lights == 1 {
                    log.warning(&format!("{variant} is left out: {reason}"));
                }
                continue;
            }
            all.push(SpanTimes {
                method: variant.to_string(),
                lights: *lights,
                ns: Vec::new(),
            });
            for length in LENGTHS {
                let mut out = vec![[0.0; 3]; length];
                spans.push(Box::new(move || {
                    variant.shade_span(black_box(bench), black_box(&mut out));
                }));
            }
        }
    }
    let limits = TimeLimits {
        time_budget: Duration::MAX,
        rounds: ROUNDS,
        warm_up_rounds: 1,
    };
    let timed = time_interleaved(Clock::new(1), &mut spans, &[], limits, |part| {
        progress.at(part, "spans")
    });
    for (i, timing) in timed.timings().enumerate() {
        all[i / LENGTHS.len()].ns.push(timing.typical_ns);
    }
    let noise = timed.noise(&[]);
    let text = format!("{}{}\n", table(&all), noise.sentence);
    let document = Document {
        schema: SCHEMA,
        command_line: command_line(),
        machine: Machine::this(),
        degrees: DEGREES,
        lengths: LENGTHS,
        noise,
        spans: &all,
    };
    let json = serde_json::to_string_pretty(&document)? + "\n";
    Ok((text, json))
}

/// Returns a table of nanoseconds per pixel, with a row for each method.
fn table(all: &[SpanTimes]) -> String {
    let mut table = Table::new("", &["ns per pixel, spans of", "lights"]);
    table.head.extend(LENGTHS.map(|length| length.to_string()));
    table.rows = (all.iter())
        .map(|times| {
            let pixels = LENGTHS.iter().zip(&times.ns);
            let pixels = pixels.map(|(length, ns)| format!("{:.2}", ns / *length as f64));
            [times.method.clone(), times.lights.to_string()]
                .into_iter()
                .chain(pixels)
                .collect()
        })
        .collect();
    table.text()
}
