//! How often do the ratios of `fastphong bench` hold beside other programs?
//!
//! ```text
//! cargo bench --bench trust -- SECONDS REPEATS
//! ```
//!
//! takes the ratios of nine methods on four scenes on a machine that should do nothing else, for
//! ten times SECONDS a scene. Five processes share the time, and their medians are the quiet
//! values. Then it takes the ratios REPEATS times within SECONDS, beside 0, 2, 8 and 16 busy
//! processes of each kind of [`Load`], and counts how many are near the quiet value, and how many
//! intervals hold it. Each table is taken by another process. Every method is there under two
//! names, too: how often is one of these called faster than the other? The results are in
//! docs/reliability.md.

mod scenes;

use fastphong::frame::triangulate::triangulated;
use fastphong::number::SimdLevel;
use fastphong::raster::{Edges, Renderer};
use fastphong::shading::Variant;
use fastphong_cli::compare::timing::{
    Candidate, Clock, Ratio, TimeLimits, Trust, time_interleaved,
};
use serde::{Deserialize, Serialize};
use std::hint::black_box;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A mesh, and the instructions to draw it by.
struct TrustScene {
    mesh: &'static str,
    level: fn() -> SimdLevel,
}

/// A sphere of many small polygons.
const SPHERE: &str = "sphere?polygons=5000&triangles=true";

/// The scenes: few large polygons, many small ones, polygons of many corners; many small ones with
/// SIMD.
const SCENES: [TrustScene; 4] = [
    TrustScene::scalar("prism"),
    TrustScene::scalar(SPHERE),
    TrustScene::scalar("knot"),
    TrustScene {
        mesh: SPHERE,
        level: SimdLevel::best,
    },
];

impl TrustScene {
    const fn scalar(mesh: &'static str) -> TrustScene {
        TrustScene {
            mesh,
            level: || SimdLevel::Scalar,
        }
    }
}

/// The methods; the others are compared with the first one.
const METHODS: [&str; 9] = [
    "naive-phong",
    "flat",
    "gouraud",
    "gouraud-separate",
    "fast-phong",
    "phong-rsqrt",
    "duff-phong",
    "six-point",
    "adaptive-phong",
];

/// The numbers of busy processes.
const COUNTS: [usize; 4] = [0, 2, 8, 16];

/// The quiet values are medians of so many processes.
const QUIET: usize = 5;

/// What a busy process does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Load {
    /// Chained square roots.
    Arithmetic,
    /// Streams through 32 MiB of memory.
    Stream,
    /// Both, in turns.
    Mixed,
    /// Arithmetic of up to 6 ms, then sleep of up to 3 ms.
    Bursts,
}

const LOADS: [Load; 4] = [Load::Arithmetic, Load::Stream, Load::Mixed, Load::Bursts];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words.iter().any(|word| word == "--test") {
        return;
    }
    // `cargo bench` adds `--bench`.
    let words = words.iter().filter(|word| *word != "--bench");
    let words: Vec<&str> = words.map(String::as_str).collect();
    let number = |place: usize, otherwise| {
        let word = words.get(place);
        word.map_or(otherwise, |word| word.parse().expect("a number"))
    };
    match words.first().copied() {
        Some("table") => {
            let table = Table::take(
                &SCENES[number(1, 0.0) as usize],
                number(2, 2.0),
                words.len() > 3,
            );
            serde_json::to_writer(std::io::stdout(), &table).expect("an open output");
        }
        Some(name) if let Some(load) = LOADS.into_iter().find(|load| load.name() == name) => {
            load.run(number(1, 1.0) as u64);
        }
        _ => measure(number(0, 2.0), number(1, 3.0) as usize),
    }
}

/// Measures and prints all rows.
fn measure(seconds: f64, repeats: usize) {
    let scenes = 0..SCENES.len();
    let table = |scene, seconds, may_stop| Table::of_process(scene, seconds, may_stop);
    let mut quiet = Vec::new();
    for (i, scene) in SCENES.iter().enumerate() {
        let tables = [(); QUIET].map(|()| table(i, 10.0 * seconds / QUIET as f64, false));
        let name = format!("{}, {}", scene.mesh, (scene.level)());
        for table in &tables {
            println!("{name}: {} ({} rounds)", table.sentence, table.rounds);
        }
        let median = |ratio: usize| {
            let mut ratios = tables.each_ref().map(|table| table.ratios[ratio].typical);
            ratios.sort_by(f64::total_cmp);
            ratios[QUIET / 2]
        };
        let medians: Vec<f64> = (0..METHODS.len() - 1).map(median).collect();
        quiet.push(medians);
    }
    println!(
        "load | tables | too busy | interrupted | in 3 % | in 3 %, not too busy | hold | half interval | called faster"
    );
    let mut all = Score::default();
    for count in COUNTS {
        for load in LOADS.iter().take(if count == 0 { 1 } else { LOADS.len() }) {
            let others = Others::start(
                *load,
                count,
                2 * repeats * SCENES.len() * (seconds as usize + 2),
            );
            let mut score = Score::default();
            for _ in 0..repeats {
                for (scene, quiet) in scenes.clone().zip(&quiet) {
                    score.add(&table(scene, seconds, true), quiet);
                }
            }
            drop(others);
            println!("{count} {} | {}", load.name(), score.line());
            all.join(score);
        }
    }
    println!("all | {}", all.line());
}

/// The ratios of a scene.
#[derive(Deserialize, Serialize)]
struct Table {
    sentence: String,
    rounds: usize,
    /// True if nothing can be said.
    is_too_busy: bool,
    /// The part of the samples that was interrupted.
    interrupted: f64,
    /// The ratios of the methods to the first one.
    ratios: Vec<Ratio>,
    /// The ratios of every method to itself under another name.
    twins: Vec<Ratio>,
}

impl Table {
    /// Takes the ratios in a process of its own, which has its code and memory in another place.
    fn of_process(scene: usize, seconds: f64, may_stop: bool) -> Table {
        let own = std::env::current_exe().expect("the path of this program");
        let mut process = Command::new(own);
        process.args(["table", &scene.to_string(), &seconds.to_string()]);
        // Its own errors are seen, where a table is missing.
        process.stderr(Stdio::inherit());
        let output = process.args(may_stop.then_some("stop")).output();
        let output = output.expect("this program runs");
        serde_json::from_slice(&output.stdout).expect("a table")
    }

    /// Takes the ratios, like `fastphong bench`, and stops when they are known if `may_stop`.
    fn take(scene: &TrustScene, seconds: f64, may_stop: bool) -> Table {
        rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .use_current_thread()
            .build_global()
            .expect("no pool before");
        let limits = TimeLimits {
            time_budget: Duration::from_secs_f64(seconds),
            ..TimeLimits::default()
        };
        let frame = &scenes::scene(scene.mesh).frame().expect("a valid scene");
        let renderer = Renderer::on((scene.level)());
        let triangles = triangulated(frame).frame;
        let variants = METHODS.map(|name| Variant::parse(name).expect("a method"));
        let draw = |variant| -> Candidate<'_> {
            Box::new(move || {
                let _ = black_box(Variant::render_with(variant, black_box(frame), renderer));
            })
        };
        let mut candidates: Vec<Candidate<'_>> = variants.iter().map(draw).collect();
        candidates.extend(variants.iter().map(draw));
        // The rows that take longest in such a table.
        for variant in &variants[..3] {
            candidates.push(Box::new(|| {
                black_box(variant.render_barycentric(black_box(&triangles), Edges::TopLeft));
            }));
        }
        let count = METHODS.len();
        let pairs: Vec<(usize, usize)> = (1..count).map(|i| (0, i)).collect();
        let twins = (0..count).map(|i| (i, count + i));
        let wanted = if may_stop { &pairs[..] } else { &[] };
        let times = time_interleaved(Clock::new(1), &mut candidates, wanted, limits, |_| ());
        let ratio = |(a, b): (usize, usize)| times.ratio(a, b).expect("some time");
        let noise = times.noise(&pairs);
        Table {
            is_too_busy: noise.trust == Trust::TooBusy,
            interrupted: noise.interrupted,
            rounds: noise.rounds,
            sentence: noise.sentence,
            ratios: pairs.iter().copied().map(ratio).collect(),
            twins: twins.map(ratio).collect(),
        }
    }
}

/// A ratio beside busy processes.
struct Judged {
    /// The difference from the quiet value, as a part of it.
    error: f64,
    /// True if the interval holds the quiet value.
    holds: bool,
    /// Half the interval, as a part of the ratio.
    doubt: f64,
    /// True if its table is too busy to tell.
    is_too_busy: bool,
}

/// Counts over several tables.
#[derive(Default)]
struct Score {
    tables: usize,
    too_busy: usize,
    interrupted: f64,
    ratios: Vec<Judged>,
    twins: usize,
    called_faster: usize,
}

impl Score {
    fn add(&mut self, table: &Table, quiet: &[f64]) {
        self.tables += 1;
        self.too_busy += usize::from(table.is_too_busy);
        self.interrupted += table.interrupted;
        for (ratio, quiet) in table.ratios.iter().zip(quiet) {
            self.ratios.push(Judged {
                error: (ratio.typical / quiet - 1.0).abs(),
                holds: (ratio.low..=ratio.high).contains(quiet),
                doubt: ratio.doubt(),
                is_too_busy: table.is_too_busy,
            });
        }
        self.twins += table.twins.len();
        self.called_faster += table.twins.iter().filter(|ratio| !ratio.tie).count();
    }

    fn join(&mut self, other: Score) {
        self.tables += other.tables;
        self.too_busy += other.too_busy;
        self.interrupted += other.interrupted;
        self.ratios.extend(other.ratios);
        self.twins += other.twins;
        self.called_faster += other.called_faster;
    }

    fn line(&self) -> String {
        let is_near = |ratio: &Judged| ratio.error <= 0.03;
        let mut doubts: Vec<f64> = self.ratios.iter().map(|ratio| ratio.doubt).collect();
        doubts.sort_by(f64::total_cmp);
        format!(
            "{} | {} | {:.0} % | {} | {} | {} | {:.1} % | {} of {}",
            self.tables,
            self.too_busy,
            100.0 * self.interrupted / self.tables as f64,
            share(self.ratios.iter().map(is_near)),
            share(
                self.ratios
                    .iter()
                    .filter(|ratio| !ratio.is_too_busy)
                    .map(is_near)
            ),
            share(self.ratios.iter().map(|ratio| ratio.holds)),
            100.0 * doubts[doubts.len() / 2],
            self.called_faster,
            self.twins,
        )
    }
}

/// Writes the share of true values.
fn share(values: impl Iterator<Item = bool> + Clone) -> String {
    match values.clone().count() {
        0 => "–".to_owned(),
        count => format!(
            "{:.0} %",
            100.0 * values.filter(|is| *is).count() as f64 / count as f64
        ),
    }
}

/// Busy processes, which end with this value.
struct Others(Vec<Child>);

impl Others {
    /// Starts processes, each in its own session if `setsid` is there: Linux shares processors
    /// fairly between sessions, so that each weighs as much as the benchmark. They end by
    /// themselves after some seconds if nobody ends them.
    fn start(load: Load, count: usize, seconds: usize) -> Others {
        let own = std::env::current_exe().expect("the path of this program");
        let start = |_| {
            let words = [load.name(), &seconds.to_string()].map(str::to_owned);
            let mut with_session = Command::new("setsid");
            with_session.arg(&own).args(&words).stdout(Stdio::null());
            let started = with_session.spawn();
            started.or_else(|_| Command::new(&own).args(&words).spawn())
        };
        let children = (0..count).map(start).collect::<Result<_, _>>();
        let others = Others(children.expect("this program runs"));
        // Until they have their memory.
        std::thread::sleep(Duration::from_millis(if count == 0 { 0 } else { 500 }));
        others
    }
}

impl Drop for Others {
    fn drop(&mut self) {
        for child in &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

impl Load {
    fn name(self) -> &'static str {
        match self {
            Load::Arithmetic => "arithmetic",
            Load::Stream => "stream",
            Load::Mixed => "mixed",
            Load::Bursts => "bursts",
        }
    }

    /// Keeps a processor busy for some seconds.
    fn run(self, seconds: u64) {
        let end = Instant::now() + Duration::from_secs(seconds);
        let mut memory = vec![1u64; if self == Load::Arithmetic { 0 } else { 4 << 20 }];
        let mut random = u64::from(std::process::id());
        let mut turn = 0;
        while Instant::now() < end {
            turn += 1;
            let is_stream = match self {
                Load::Stream => true,
                Load::Mixed => turn % 2 == 0,
                Load::Arithmetic | Load::Bursts => false,
            };
            if is_stream {
                memory
                    .iter_mut()
                    .for_each(|value| *value = value.wrapping_mul(3).wrapping_add(1));
                black_box(&mut memory);
                continue;
            }
            // MMIX, Knuth.
            random = random
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            let length = Duration::from_micros((random >> 33) % 6000);
            let until = Instant::now() + length;
            while Instant::now() < until {
                let sum = (0..500).fold(1.0f64, |x, _| black_box((x + 1.0).sqrt() * 1.7));
                black_box(sum);
            }
            if self == Load::Bursts {
                std::thread::sleep(Duration::from_micros((random >> 20) % 3000));
            }
        }
    }
}
