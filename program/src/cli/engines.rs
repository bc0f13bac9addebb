//! Flags for engines, instruction sets and threads.

use super::CliError;
use super::values::number;
use fastphong::number::suggest::{one_of, unknown};
use fastphong::number::{NameError, SimdLevel};
use fastphong::raster::{Edges, Engine, Renderer};
use fastphong::reference::cs171::Shading;
use fastphong::shading::{Info, METHODS, MethodRow};
use serde_json::{Value, json};

/// An engine that a user can ask for, with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineFlag {
    /// A scanline engine, span or row. `None` lets method and frame decide.
    Scanlines(ScanlineEngine),
    /// Bounding boxes and edge functions.
    Barycentric(Edges),
    /// CS171's algorithms in `f64`.
    Cs171 {
        /// True to normalise interpolated normals, a step that the printed text leaves out.
        normalise: bool,
    },
}

/// The description of an engine.
#[derive(serde::Serialize)]
pub struct EngineInfo {
    /// The name on the command line.
    pub name: &'static str,
    /// One sentence.
    pub title: &'static str,
    /// Which scenes and methods it can draw.
    pub draws: &'static str,
    /// Which instruction sets and how many threads it uses.
    pub runs: &'static str,
}

/// All engines.
pub const ENGINES: [EngineInfo; 4] = [
    EngineInfo {
        name: "span",
        title: "the lecture's way, one pixel at a time: active edges, a depth buffer of one line, each visible run shaded once",
        draws: "every method, on every scene that the method can draw",
        runs: "scalar, one thread",
    },
    EngineInfo {
        name: "row",
        title: "a deferred renderer with SIMD: it keeps varyings in a G-buffer and shades each row once",
        draws: "every method under any lights, with interpolated depth and clipping by planes. The span engine draws the rest",
        runs: "every SIMD instruction set, several threads",
    },
    EngineInfo {
        name: "barycentric",
        title: "a bounding box per triangle, three edge functions per pixel; the lecture's way is compared with it",
        draws: "triangles, so it cuts polygons into them; :edges=top-left or :edges=closed",
        runs: "scalar, one thread",
    },
    EngineInfo {
        name: "cs171",
        title: "CS171's algorithms as printed",
        draws: "triangles, so it cuts polygons into them; :normals=unit or :normals=as-printed",
        runs: "f64, one thread",
    },
];

impl EngineInfo {
    /// Returns the names of the methods that the engine can draw.
    pub fn methods(&self) -> impl Iterator<Item = &'static str> {
        let methods = METHODS.iter().filter(|method| self.has(method));
        methods.map(|method| method.info.name)
    }

    fn has(&self, method: &MethodRow) -> bool {
        match self.name {
            "barycentric" => method.is_barycentric(),
            "cs171" => cs171_shading(method.info).is_some(),
            _ => true,
        }
    }

    /// Returns the description as JSON.
    pub fn json(&self) -> Value {
        let mut json = json!(self);
        json["methods"] = self.methods().collect();
        json
    }
}

/// Returns the names of the engines that can draw a method.
pub fn engines_with(method: &MethodRow) -> String {
    let engines = ENGINES.iter().filter(|engine| engine.has(method));
    let names: Vec<&str> = engines.map(|engine| engine.name).collect();
    names.join(", ")
}

/// Returns the algorithm of CS171 for a method, or `None` if it has none.
pub fn cs171_shading(info: &Info) -> Option<Shading> {
    match info.name {
        "flat-average" => Some(Shading::Flat),
        "gouraud" => Some(Shading::Gouraud),
        "naive-phong" => Some(Shading::Phong),
        _ => None,
    }
}

/// Reads `auto`, `span`, `row`, `barycentric`, `barycentric:edges=top-left|closed`, `cs171` or
/// `cs171:normals=unit|as-printed`.
pub fn engine(text: &str) -> Result<EngineFlag, String> {
    const NAMES: [&str; 5] = ["auto", "span", "row", "barycentric", "cs171"];
    match text {
        "auto" => return Ok(EngineFlag::Scanlines(None)),
        "span" => return Ok(EngineFlag::Scanlines(Some(Engine::Span))),
        "row" => return Ok(EngineFlag::Scanlines(Some(Engine::Row))),
        "barycentric" | "barycentric:edges=top-left" => {
            return Ok(EngineFlag::Barycentric(Edges::TopLeft));
        }
        "barycentric:edges=closed" => return Ok(EngineFlag::Barycentric(Edges::Closed)),
        "cs171" | "cs171:normals=unit" => return Ok(EngineFlag::Cs171 { normalise: true }),
        "cs171:normals=as-printed" => return Ok(EngineFlag::Cs171 { normalise: false }),
        _ => {}
    }
    Err(match text.split_once(':') {
        Some(("barycentric", _)) => "expected edges=top-left or edges=closed".to_owned(),
        Some(("cs171", _)) => "expected normals=unit or normals=as-printed".to_owned(),
        Some((name, _)) if NAMES.contains(&name) => {
            format!("the engine `{name}` has no parameters")
        }
        _ => unknown("engine", text, NAMES),
    })
}

/// A scanline engine; `None` is `auto`.
pub type ScanlineEngine = Option<Engine>;

/// Reads `auto`, `span` or `row`.
pub fn scanline_engine(text: &str) -> Result<ScanlineEngine, String> {
    const NAMES: [&str; 3] = ["auto", "span", "row"];
    match engine(text) {
        Ok(EngineFlag::Scanlines(engine)) => Ok(engine),
        Ok(EngineFlag::Barycentric(_)) => Err(format!(
            "every comparison includes it already: {}",
            one_of(NAMES)
        )),
        Ok(EngineFlag::Cs171 { .. }) | Err(_) => Err(unknown("engine", text, NAMES)),
    }
}

/// An instruction set of this machine; `None` is `auto`, the best.
pub type Simd = Option<SimdLevel>;

/// Reads `auto`, or an instruction set of this machine.
pub fn simd(text: &str) -> Result<Simd, NameError> {
    match text {
        "auto" => Ok(None),
        name => name.parse().map(Some),
    }
}

/// Returns the renderer for an engine and an instruction set, or `default` if neither is set.
///
/// The two are one choice: the span engine is scalar, the row engine needs SIMD.
///
/// # Errors
/// If they contradict each other; the message says what to ask for instead.
pub fn renderer(
    engine: Option<ScanlineEngine>,
    simd: Option<Simd>,
    default: Renderer,
) -> Result<Renderer, String> {
    if engine.is_none() && simd.is_none() {
        return Ok(default);
    }
    let problem = match (engine.flatten(), simd.flatten()) {
        (Some(Engine::Span), None | Some(SimdLevel::Scalar)) => return Ok(Renderer::Span),
        (Some(Engine::Span), Some(level)) => &*format!(
            "the span engine goes one pixel at a time: use `--engine row --simd {level}`, or `--engine span --simd scalar`"
        ),
        (Some(Engine::Row), Some(SimdLevel::Scalar)) => {
            "the row engine runs on SIMD: use `--engine span --simd scalar` for one pixel at a time, or `--simd auto`"
        }
        (engine, level) => match (engine, Renderer::on(level.unwrap_or_else(SimdLevel::best))) {
            (Some(Engine::Row), Renderer::Span) => {
                "the row engine runs on SIMD, which this machine does not have: use `--engine span`"
            }
            (_, renderer) => return Ok(renderer),
        },
    };
    Err(problem.to_owned())
}

/// A list of instruction sets. An empty one stands for all that the engine can use.
pub type SimdList = Vec<Simd>;

/// Reads instruction sets of this machine, separated by commas, or `all`.
pub fn simd_list(text: &str) -> Result<SimdList, NameError> {
    match text {
        "all" => Ok(Vec::new()),
        names => names.split(',').map(|name| simd(name.trim())).collect(),
    }
}

/// The engine flags of commands that by default draw as in the lecture.
#[derive(clap::Args, Clone, Debug)]
pub struct LectureFlags {
    /// Engine that finds the pixels: `span`, as in the lecture, one pixel at a time on one thread;
    /// `row`, with SIMD; or `auto`, which is `row` if it can draw the frame, else `span` [default:
    /// span]
    #[arg(long, value_parser = scanline_engine)]
    engine: Option<ScanlineEngine>,
    /// Instruction set of the pixel loops: `scalar` selects the span engine; `auto`, or any other
    /// of `fastphong list simd`, the row engine [default: scalar]
    #[arg(long, value_name = "ISA", value_parser = simd)]
    simd: Option<Simd>,
    #[command(flatten)]
    pub threads: ThreadFlags,
}

impl LectureFlags {
    /// Returns the renderer that the flags ask for.
    ///
    /// # Errors
    /// As [`renderer`].
    pub fn renderer(&self) -> Result<Renderer, CliError> {
        Ok(renderer(self.engine, self.simd, Renderer::LECTURE)?)
    }
}

/// The flag for the number of threads.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ThreadFlags {
    /// Number of threads, 1 to 1024 [default: one per processor]. When methods are compared, the
    /// span engine uses one
    #[arg(long, value_name = "N", value_parser = threads, allow_hyphen_values = true)]
    pub threads: Option<usize>,
}

/// The largest number of threads: more than any machine has processors, yet cheap in memory.
const MOST_THREADS: usize = 1024;

/// The stack of each thread, in bytes: as large as the main thread's on most systems.
const STACK: usize = 8 << 20;

/// Reads a number of threads.
pub fn threads(text: &str) -> Result<usize, String> {
    let expected = format!("a number of threads from 1 to {MOST_THREADS}");
    number(text, expected, |n| (1..=MOST_THREADS).contains(n))
}

/// The environment variables from which rayon reads the number of threads if no flag sets it. The
/// second is an older name.
const THREAD_VARIABLES: [&str; 2] = ["RAYON_NUM_THREADS", "RAYON_RS_NUM_CPUS"];

/// Checks the number of threads that the environment sets. Rayon ignores 0 and anything that is not
/// a number, and so does this.
///
/// # Errors
/// If `--threads` would refuse the number because it is too large.
pub fn check_environment() -> Result<(), CliError> {
    for name in THREAD_VARIABLES {
        let value = std::env::var_os(name).unwrap_or_default();
        let value = value.to_string_lossy();
        let digits = value.strip_prefix('+').unwrap_or(&value);
        let is_whole = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        if is_whole && digits.bytes().any(|byte| byte != b'0') {
            threads(&value).map_err(|expected| format!("{name}={value}: {expected}"))?;
        }
    }
    Ok(())
}

impl ThreadFlags {
    /// Starts a pool with the number of threads asked for.
    ///
    /// # Errors
    /// If the system cannot start that many.
    pub fn pool(self) -> Result<rayon::ThreadPool, CliError> {
        // To rayon, 0 means one thread per processor.
        let builder = rayon::ThreadPoolBuilder::new().num_threads(self.threads.unwrap_or(0));
        let pool = builder.stack_size(STACK).build().map_err(|error| {
            let threads = self.threads.map_or_else(String::new, |n| format!("{n} "));
            format!("{threads}threads cannot be started: {error}")
        })?;
        Ok(pool)
    }

    /// Runs `work` on a pool with the number of threads asked for.
    ///
    /// # Errors
    /// As [`ThreadFlags::pool`].
    pub fn install<T: Send>(self, work: impl FnOnce() -> T + Send) -> Result<T, CliError> {
        Ok(self.pool()?.install(work))
    }

    /// Runs `work`, which draws with `renderer`, as [`ThreadFlags::install`] does. The lecture's
    /// span engine gets a single thread even for its vertices: otherwise a comparison would measure
    /// how well they are spread over threads.
    ///
    /// # Errors
    /// As [`ThreadFlags::install`].
    pub fn install_for<T: Send>(
        self,
        renderer: Renderer,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, CliError> {
        match renderer {
            Renderer::LECTURE => ThreadFlags { threads: Some(1) }.install(work),
            _ => self.install(work),
        }
    }
}
