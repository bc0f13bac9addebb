//! `fastphong bench --frame-times`: times whole frames, from the prepared scene to the stored
//! picture, as a program that shows frame after frame would draw them.

use super::measured::{Measurement, command_line};
use super::scene_flags::note_frame;
use super::values::number;
use super::{CliError, Log, memory};
use crate::compare::timing::{Clock, End, Machine, Noise, Timing, Trust};
use fastphong::drawing::Drawing;
use fastphong::frame::PreparedScene;
use fastphong::picture::Picture8;
use fastphong::raster::{DrawOptions, Plan, Renderer};
use fastphong::shading::Variant;
use serde::Serialize;
use std::hint::black_box;

/// The schema of the data: see `docs/bench-json.md`.
const SCHEMA: &str = "fastphong.frame-times/2";

/// The definition of a frame's time.
const WHAT_IS_TIMED: &str = "from the prepared scene to the stored picture in RGBA8, in the memory of the frame before: \
                             projection, culling, clipping, vertex lighting, rasterization, shading and storing; not \
                             loading, vertex normals or writing";

/// The largest number of frames per method.
const MOST_FRAMES: usize = 1_000_000;

/// The flags for how many frames to draw. clap waives `requires` if the required flag conflicts
/// with one that is given, so both name those conflicts, too.
#[derive(clap::Args, Clone, Copy, Debug, Serialize)]
pub struct FrameCount {
    /// Number of frames to time for each method, 1 to 1000000
    #[arg(long, value_name = "N", default_value = "60", value_parser = |text: &str| frames(text, 1), allow_hyphen_values = true, requires = "frame_times", conflicts_with = "time_budget")]
    frames: usize,
    /// Number of frames to draw first for each method, 0 to 1000000, until caches and the clock
    /// frequency have settled
    #[arg(long, value_name = "N", default_value = "5", value_parser = |text: &str| frames(text, 0), allow_hyphen_values = true, requires = "frame_times", conflicts_with = "time_budget")]
    warmup: usize,
}

/// Reads a number of frames, at least `least`.
fn frames(text: &str, least: usize) -> Result<usize, String> {
    let expected = format!("a number of frames from {least} to {MOST_FRAMES}");
    number(text, expected, |n| (least..=MOST_FRAMES).contains(n))
}

/// The frames of one method.
#[derive(Serialize)]
struct FrameTime {
    input: String,
    width: usize,
    height: usize,
    method: String,
    engine: &'static str,
    level: &'static str,
    threads: usize,
    reason: Option<&'static str>,
    #[serde(flatten)]
    count: FrameCount,
    clock: &'static str,
    interrupted: usize,
    ms_typical: f64,
    ms_median: f64,
    ms_min: f64,
}

/// Times the frames of each method by each renderer, one after the other. Returns the times as text
/// and as JSON.
///
/// # Errors
/// If an input cannot be loaded or drawn.
pub fn frame_times(
    of: &Measurement<'_>,
    methods: &[Variant],
    count: FrameCount,
) -> Result<(String, String), CliError> {
    let turns = of.inputs.len() * of.renderers.len() * methods.len();
    let mut times: Vec<FrameTime> = Vec::with_capacity(turns);
    of.each_scene(|name, opened, progress| {
        memory::check_frame(&opened.scene)?;
        let prepared = opened.scene.prepare()?;
        let frame = prepared.frame()?;
        progress.aside(|| note_frame(&opened, &frame, of.log));
        drop((opened, frame));
        for renderer in of.renderers {
            for variant in methods {
                let done = times.len() as f32 / turns as f32;
                progress.at(done, &format!("{name}: {variant}"));
                let draw = || FrameTime::take(name, &prepared, variant, *renderer, (count, of.log));
                let Some(time) = of.threads.install_for(*renderer, draw)?? else {
                    continue;
                };
                if let Some(reason) = time.reason {
                    let drawn_by = format!("the {} engine, {}", time.engine, time.level);
                    let text = format!("{name}: {variant} is drawn by {drawn_by}: {reason}");
                    progress.aside(|| of.log.note(&text));
                }
                times.push(time);
            }
        }
        Ok(())
    })?;
    Ok((times.iter().map(FrameTime::line).collect(), json(&times)?))
}

impl FrameTime {
    /// Draws frame after frame into one picture, and reads the clock before and after each. Returns
    /// `None`, with a warning, if the method refuses the frame.
    fn take(
        input: &str,
        scene: &PreparedScene,
        variant: &Variant,
        renderer: Renderer,
        (count, log): (FrameCount, Log),
    ) -> Result<Option<FrameTime>, CliError> {
        let mut frame = scene.frame()?;
        let plan = variant.plan(&frame, renderer);
        if let Plan::Refused(reason) = plan {
            log.warning(&format!("{input}: {variant} is left out: {reason}"));
            return Ok(None);
        }
        let drawn_by = plan.renderer().unwrap_or(renderer);
        memory::check_stored(&frame, &Drawing::Variant(variant.clone()), 0)?;
        let mut picture = Picture8::new(frame.picture_width(), frame.picture_height(), [0; 4]);
        let mut samples = Vec::with_capacity(count.frames);
        let clock = Clock::new(rayon::current_num_threads());
        let mut interrupted = 0;
        for index in 0..count.warmup + count.frames {
            let first = clock.read(End::First);
            black_box(scene).frame_into(&mut frame)?;
            let drawn = variant.draw(&frame, &mut picture, DrawOptions::by(renderer));
            let last = clock.read(End::Last);
            black_box(&mut picture);
            drawn?;
            if index >= count.warmup {
                samples.push(clock.time(first, last));
                interrupted += usize::from(clock.is_interrupted(first, last));
            }
        }
        let timing = Timing::of(samples, 1).expect("one frame or more, each of a finite time");
        let share = interrupted as f64 / count.frames as f64;
        let noise = Noise::new(clock, share, count.frames, 0.0, 0.0);
        if noise.trust == Trust::TooBusy {
            log.warning(&format!("{input}: {variant}: {}", noise.sentence));
        }
        Ok(Some(FrameTime {
            input: input.to_owned(),
            width: picture.width(),
            height: picture.height(),
            method: variant.to_string(),
            engine: drawn_by.engine().name(),
            level: drawn_by.level().name(),
            threads: rayon::current_num_threads(),
            reason: plan.reason(),
            count,
            clock: clock.name(),
            interrupted,
            ms_typical: timing.typical_ns / 1e6,
            ms_median: timing.median_ns / 1e6,
            ms_min: timing.min_ns / 1e6,
        }))
    }

    /// Returns the line of a method.
    fn line(&self) -> String {
        let (input, method, engine, level) = (&self.input, &self.method, self.engine, self.level);
        let (width, height, threads) = (self.width, self.height, self.threads);
        let (frames, typical) = (self.count.frames, self.ms_typical);
        let (median, least, interrupted) = (self.ms_median, self.ms_min, self.interrupted);
        let drawn = format!("{input} {width}x{height} {method} engine {engine} level {level}");
        let times = format!("ms_typical {typical:.4} ms_median {median:.4} ms_min {least:.4}");
        format!("{drawn} threads {threads} frames {frames} interrupted {interrupted} {times}\n")
    }
}

/// Returns the times as JSON, with each method on its own line. `json!` would sort the fields.
fn json(times: &[FrameTime]) -> Result<String, CliError> {
    let command_line = serde_json::to_string(&command_line())?;
    let machine = serde_json::to_string(&Machine::this())?;
    let lines = times.iter().map(serde_json::to_string);
    let lines = lines.collect::<Result<Vec<String>, _>>()?.join(",\n    ");
    Ok(format!(
        "{{\n  \"schema\": \"{SCHEMA}\",\n  \"command_line\": {command_line},\n  \"machine\": {machine},\n  \
         \"timed\": \"{WHAT_IS_TIMED}\",\n  \"frame_times\": [\n    {lines}\n  ]\n}}\n"
    ))
}
