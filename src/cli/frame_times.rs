//! `fastphong bench --frame-times`: whole frames, from the prepared scene to the stored picture, as a program that shows one
//! after the other draws them.

use super::Failure;
use super::measured::{How, warn_of_debug_build};
use super::progress::Progress;
use super::scene_flags::SceneFlags;
use super::talk::Talk;
use fastphong::compare::timing::{Machine, Timing};
use fastphong::frame::{FrameError, PreparedScene};
use fastphong::picture::Picture8;
use fastphong::raster::{Plan, Renderer};
use fastphong::scene::input;
use fastphong::shading::Variant;
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

/// The schema of the data: see `docs/bench-json.md`.
const SCHEMA: &str = "fastphong.frame-times/1";

/// What a frame's time holds.
const WHAT_IS_TIMED: &str = "from the prepared scene to the stored picture in RGBA8, in the memory of the frame before: \
                             projection, culling, clipping, vertex lighting, rasterization, shading and storing; not \
                             loading, vertex normals or writing";

/// The most frames of a method.
const MOST_FRAMES: usize = 1_000_000;

/// How many frames.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct FrameCount {
    /// Frames of each method that are timed, 1 to 1000000
    #[arg(long, value_name = "N", default_value = "60", value_parser = frames, allow_hyphen_values = true, requires = "frame_times")]
    frames: usize,
    /// Frames of each method before those, 0 to 1000000: caches, branch predictors and the clock frequency settle
    #[arg(long, value_name = "N", default_value = "5", value_parser = warm_up, allow_hyphen_values = true, requires = "frame_times")]
    warmup: usize,
}

fn count(text: &str, least: usize) -> Result<usize, String> {
    let count = text
        .parse()
        .ok()
        .filter(|count| (least..=MOST_FRAMES).contains(count));
    count.ok_or_else(|| format!("expected a number of frames from {least} to {MOST_FRAMES}"))
}

fn frames(text: &str) -> Result<usize, String> {
    count(text, 1)
}

fn warm_up(text: &str) -> Result<usize, String> {
    count(text, 0)
}

/// What is to be timed.
pub struct FrameTiming<'a> {
    pub inputs: &'a [&'a str],
    pub scene: &'a SceneFlags,
    pub methods: &'a [Variant],
    pub how: How<'a>,
    pub count: FrameCount,
}

/// How frames were drawn, and how long that took.
struct Drawn {
    plan: Plan,
    threads: usize,
    size: [usize; 2],
    timing: Timing,
}

/// The frames of one method.
struct FrameTime {
    input: String,
    method: String,
    drawn: Drawn,
    count: FrameCount,
}

/// The frames of all methods on all scenes.
pub struct FrameTimes(Vec<FrameTime>);

impl FrameTiming<'_> {
    /// Draws and times, one method after the other, by each renderer.
    ///
    /// # Errors
    /// When an input cannot be loaded or drawn.
    pub fn take(&self, talk: Talk) -> Result<FrameTimes, Failure> {
        warn_of_debug_build(talk);
        // What can fail at once does so before the first minute is spent.
        let files = self
            .inputs
            .iter()
            .map(|name| self.scene.load(name))
            .collect::<Result<Vec<_>, _>>()?;
        let progress = Progress::silent_between_moves(talk);
        let turns = files.len() * self.methods.len() * self.how.renderers.len();
        let mut times = Vec::with_capacity(turns);
        for (name, file) in self.inputs.iter().zip(&files) {
            let resolved = input::resolve(file)?;
            progress.aside(|| self.scene.warn(&resolved, talk));
            let prepared = resolved.scene.prepare()?;
            drop(resolved);
            for renderer in self.how.renderers {
                for variant in self.methods {
                    progress.at(
                        times.len() as f32 / turns as f32,
                        &format!("{name}: {variant}"),
                    );
                    let draw = || time(&prepared, variant, *renderer, self.count);
                    let Drawn {
                        plan,
                        threads,
                        size,
                        timing,
                    } = self.how.threads.install_for(*renderer, draw)??;
                    if let Some(reason) = plan.reason {
                        let (engine, level) = (plan.renderer.engine(), plan.renderer.level());
                        let text = format!(
                            "{name}: {variant} is drawn by the {engine} engine, {level}: {reason}"
                        );
                        progress.aside(|| talk.note(&text));
                    }
                    let (input, method) = ((*name).to_owned(), variant.to_string());
                    times.push(FrameTime {
                        input,
                        method,
                        drawn: Drawn {
                            plan,
                            threads,
                            size,
                            timing,
                        },
                        count: self.count,
                    });
                }
            }
        }
        Ok(FrameTimes(times))
    }
}

/// Draws frame after frame into one picture; only what belongs to a frame is between two looks at the clock.
fn time(
    scene: &PreparedScene,
    variant: &Variant,
    renderer: Renderer,
    count: FrameCount,
) -> Result<Drawn, FrameError> {
    let mut frame = scene.frame()?;
    let plan = variant.plan(&frame, renderer);
    let mut picture = Picture8::new(0, 0, [0; 4]);
    let mut samples = Vec::with_capacity(count.frames);
    for number in 0..count.warmup + count.frames {
        let started = Instant::now();
        black_box(scene).frame_into(&mut frame)?;
        variant.render_with(&frame, renderer, &mut picture);
        let spent = started.elapsed();
        black_box(&mut picture);
        if number >= count.warmup {
            samples.push(spent.as_nanos() as f64);
        }
    }
    let timing = Timing::of(samples, 1).expect("one frame or more, each of a finite time");
    Ok(Drawn {
        plan,
        threads: rayon::current_num_threads(),
        size: [picture.width(), picture.height()],
        timing,
    })
}

impl FrameTime {
    fn milliseconds(&self) -> [f64; 2] {
        [self.drawn.timing.median_ns, self.drawn.timing.min_ns].map(|ns| ns / 1e6)
    }

    fn line(&self) -> String {
        let FrameTime {
            input,
            method,
            count,
            drawn,
        } = self;
        let Drawn {
            plan,
            threads,
            size: [width, height],
            ..
        } = drawn;
        let (engine, level) = (plan.renderer.engine(), plan.renderer.level());
        let [median, min] = self.milliseconds();
        format!(
            "{input} {width}x{height} {method} engine {engine} level {level} threads {threads} frames {} ms_median \
             {median:.4} ms_min {min:.4}\n",
            count.frames
        )
    }

    fn json(&self) -> Value {
        let Drawn {
            plan,
            threads,
            size: [width, height],
            ..
        } = &self.drawn;
        let [median, min] = self.milliseconds();
        json!({
            "input": self.input,
            "width": width,
            "height": height,
            "method": self.method,
            "engine": plan.renderer.engine().name(),
            "level": plan.renderer.level().name(),
            "threads": threads,
            "reason": plan.reason,
            "frames": self.count.frames,
            "warmup": self.count.warmup,
            "ms_median": median,
            "ms_min": min,
        })
    }
}

impl FrameTimes {
    /// A line a method.
    pub fn text(&self) -> String {
        self.0.iter().map(FrameTime::line).collect()
    }

    /// The same as JSON, in which each method stands on a line of its own, too.
    pub fn json(&self, machine: &Machine, command_line: &[String]) -> String {
        let head = [
            ("schema", json!(SCHEMA)),
            ("command_line", json!(command_line)),
            ("machine", json!(machine)),
            ("timed", json!(WHAT_IS_TIMED)),
        ];
        let mut text = String::from("{\n");
        for (name, value) in head {
            text += &format!("  \"{name}\": {value},\n");
        }
        let lines: Vec<String> = self
            .0
            .iter()
            .map(|time| format!("    {}", time.json()))
            .collect();
        text + &format!("  \"frame_times\": [\n{}\n  ]\n}}\n", lines.join(",\n"))
    }
}
