//! `fastphong bench --spans`: single spans of rising length, shaded by the methods' scalar loops alone, set-up included.

use super::CliError;
use super::Log;
use super::measured::command_line;
use super::progress::Progress;
use fastphong::compare::table::Table;
use fastphong::compare::timing::Machine;
use fastphong::shading::{SpanBench, Variant};
use serde::Serialize;
use serde_json::json;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// The schema of the data: see `docs/bench-json.md`.
const SCHEMA: &str = "fastphong.spans/1";

/// Degrees between the normals at the ends of a span.
const DEGREES: f32 = 20.0;
/// Pixels of the spans.
const LENGTHS: [usize; 11] = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024];
/// The time that one reading of the clock covers at least.
const SAMPLE: Duration = Duration::from_micros(50);
/// Rounds, in each of which every method takes its turn at every length. The least time of all is kept.
const ROUNDS: usize = 15;

/// The times of a method with so many lights.
#[derive(Clone, Debug, Serialize)]
struct SpanTimes {
    method: String,
    lights: usize,
    /// Nanoseconds of a span of each length.
    ns: Vec<f64>,
}

/// Times spans with one light and with four; returns the times as text and as JSON.
pub fn span_times(methods: &[Variant], log: Log) -> Result<(String, String), CliError> {
    let progress = Progress::silent_between_moves(log);
    let benches = [1, 4].map(|lights| (lights, SpanBench::new(DEGREES, lights)));
    let mut all = Vec::new();
    for variant in methods {
        if let Some(reason) = benches[0].1.refuses(variant) {
            log.warning(&format!("{variant} is left out: {reason}"));
        }
    }
    let is_for = |variant: &&Variant| benches[0].1.refuses(variant).is_none();
    let methods: Vec<&Variant> = methods.iter().filter(is_for).collect();
    for (lights, _) in &benches {
        all.extend(methods.iter().map(|variant| SpanTimes {
            method: variant.to_string(),
            lights: *lights,
            ns: vec![f64::INFINITY; LENGTHS.len()],
        }));
    }
    let mut out = vec![[0.0; 3]; LENGTHS[LENGTHS.len() - 1]];
    for round in 0..ROUNDS {
        progress.at(round as f32 / ROUNDS as f32, "spans");
        let mut row = all.iter_mut();
        for (_, bench) in &benches {
            for (variant, times) in methods.iter().zip(row.by_ref()) {
                for (length, least) in LENGTHS.into_iter().zip(&mut times.ns) {
                    *least = least.min(time(variant, bench, &mut out[..length]));
                }
            }
        }
    }
    let head = json!({
        "schema": SCHEMA, "command_line": command_line(), "machine": Machine::this(),
        "degrees": DEGREES, "lengths": LENGTHS, "spans": all,
    });
    let json = format!("{head:#}\n");
    Ok((table(&all), json))
}

/// Returns the nanoseconds of a span, the mean of as many as a sample takes.
fn time(variant: &Variant, bench: &SpanBench, out: &mut [[f32; 3]]) -> f64 {
    let mut calls = 0u32;
    let started = Instant::now();
    loop {
        for _ in 0..4 {
            variant.shade_span(black_box(bench), black_box(&mut *out));
        }
        calls += 4;
        let spent = started.elapsed();
        if spent >= SAMPLE {
            return spent.as_nanos() as f64 / f64::from(calls);
        }
    }
}

/// Writes nanoseconds a pixel, a row a method.
fn table(all: &[SpanTimes]) -> String {
    let mut table = Table::new("", &["ns a pixel of spans of", "lights"]);
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
