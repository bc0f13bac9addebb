//! How often do the ratios of `fastphong bench` hold beside other programs?
//!
//! ```text
//! cargo bench --bench trust -- SECONDS REPEATS
//! ```
//!
//! takes the ratios of nine methods on three scenes on a machine that should do nothing else, for
//! ten times SECONDS a scene: the quiet values. Then it takes them REPEATS times within SECONDS,
//! beside 0, 2, 8 and 16 busy processes of each kind of [`Load`], and counts how many are near the
//! quiet value, and how many intervals hold it. Every method is there under two names, too: how
//! often is one of these called faster than the other? The results are in docs/reliability.md.

mod scenes;

use fastphong::frame::Frame;
use fastphong::frame::triangulate::triangulated;
use fastphong::raster::{Edges, Renderer};
use fastphong::shading::Variant;
use fastphong_cli::compare::timing::{
    Candidate, Clock, Noise, Ratio, TimeLimits, Trust, time_interleaved,
};
use std::hint::black_box;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The scenes: few large polygons, many small ones, polygons of many corners.
const SCENES: [&str; 3] = ["prism", "sphere?polygons=5000&triangles=true", "knot"];

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
    let mut words = words.iter().filter(|word| !word.starts_with("--"));
    let first = words.next().map_or("2", String::as_str);
    let second = words.next().map_or("3", String::as_str);
    if let Some(load) = LOADS.into_iter().find(|load| load.name() == first) {
        return load.run(second.parse().expect("a number"));
    }
    let seconds: f64 = first.parse().expect("SECONDS");
    let repeats: usize = second.parse().expect("REPEATS");
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .expect("no pool before");
    let frames = SCENES.map(|mesh| scenes::scene(mesh).frame().expect("a valid scene"));
    let long = TimeLimits {
        time_budget: Duration::from_secs_f64(10.0 * seconds),
        rounds: usize::MAX,
        ..TimeLimits::default()
    };
    let quiet: Vec<Table> = frames
        .iter()
        .map(|frame| Table::take(frame, long, false))
        .collect();
    for (scene, table) in SCENES.iter().zip(&quiet) {
        println!(
            "{scene}: {} ({} rounds)",
            table.noise.sentence, table.noise.rounds
        );
    }
    println!(
        "load | tables | too busy | interrupted | in 3 % | in 3 %, not too busy | hold | half interval | called faster"
    );
    let limits = TimeLimits {
        time_budget: Duration::from_secs_f64(seconds),
        ..TimeLimits::default()
    };
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
                for (frame, quiet) in frames.iter().zip(&quiet) {
                    score.add(&Table::take(frame, limits, true), quiet);
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
struct Table {
    noise: Noise,
    /// The ratios of the methods to the first one.
    ratios: Vec<Ratio>,
    /// The ratios of every method to itself under another name.
    twins: Vec<Ratio>,
}

impl Table {
    /// Takes the ratios, like `fastphong bench`, and stops when they are known if `may_stop`.
    fn take(frame: &Frame, limits: TimeLimits, may_stop: bool) -> Table {
        let triangles = triangulated(frame).frame;
        let variants = METHODS.map(|name| Variant::parse(name).expect("a method"));
        let draw = |variant| -> Candidate<'_> {
            Box::new(move || {
                let _ = black_box(Variant::render_with(
                    variant,
                    black_box(frame),
                    Renderer::LECTURE,
                ));
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
        Table {
            noise: times.noise(&pairs),
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
    fn add(&mut self, table: &Table, quiet: &Table) {
        let is_too_busy = table.noise.trust == Trust::TooBusy;
        self.tables += 1;
        self.too_busy += usize::from(is_too_busy);
        self.interrupted += table.noise.interrupted;
        for (ratio, quiet) in table.ratios.iter().zip(&quiet.ratios) {
            self.ratios.push(Judged {
                error: (ratio.typical / quiet.typical - 1.0).abs(),
                holds: (ratio.low..=ratio.high).contains(&quiet.typical),
                doubt: ratio.doubt(),
                is_too_busy,
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
