//! `fastphong view`: a scene in a window, by two methods side by side.

mod window;

use super::engines::{self, Simd, ThreadFlags, renderer};
use super::input_name;
use super::measured::{Methods, methods, warn_of_debug_build};
use super::name_template::scene_name;
use super::polygon_counts::warn_of_polygons_left_out;
use super::scene_flags::SceneFlags;
use super::watch::Watched;
use super::{CliError, Log, Outcome, memory};
use fastphong::raster::Renderer;
use fastphong::view::{Action, Loaded, Panes, Viewer};

/// Show a scene or a mesh in a window: turn it, and compare two methods by a divider
#[derive(clap::Args, Clone, Debug)]
#[command(after_help = KEYS)]
pub struct ViewArgs {
    /// Scene file, mesh file, builtin:NAME?key=value, name of a shipped scene, or `-` for standard input
    #[arg(value_parser = input_name::parser())]
    input: String,
    /// Methods of the keys 1 to 9, between commas, with parameters as in `fast-phong:steps=1`. The first two are shown at first
    #[arg(short, long, visible_alias = "method", value_name = "METHODS", default_value = METHODS, value_parser = at_most_nine)]
    methods: Methods,
    /// Engine that finds the pixels: `span`, as in the lecture, one pixel at a time; `row` (SIMD); `auto`: `row` if it
    /// supports the scene, else `span`
    #[arg(long, default_value = "auto", value_parser = engines::scanline_engine)]
    engine: engines::ScanlineEngine,
    /// Instruction set of the pixel loops: `auto`, the best of this machine, or one of `fastphong list simd`. `scalar` selects
    /// the span engine, any other the row engine
    #[arg(long, value_name = "ISA", default_value = "auto", value_parser = engines::simd)]
    simd: Simd,
    #[command(flatten)]
    threads: ThreadFlags,
    /// Load again whenever a file of the scene changes
    #[arg(long)]
    watch: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

/// What the keys choose from: the lecture's own first, each once.
const METHODS: &str = "gouraud,fast-phong,naive-phong,phong-rsqrt,flat,duff-phong,six-point,slerp-phong,fast-phong-rsqrt";

const KEYS: &str = "In the window:\n  \
    1 to 9         the method on the side of the pointer; with Shift on the other side\n  \
    drag, arrows   turn; Home returns to the camera of the scene\n  \
    wheel, + -     zoom\n  \
    drag the line  compare; also Shift with arrows. Space shows one side alone, Tab exchanges them\n  \
    L              let the lights turn with the eye, or stay\n  \
    Esc, Q         close\n\
    The title says what is shown, and how long each picture and the projection that both share take.";

/// Reads at most as many methods as there are keys.
fn at_most_nine(text: &str) -> Result<Methods, String> {
    let methods = methods(text).map_err(|error| error.to_string())?;
    match methods.len() {
        0..=Panes::MOST => Ok(methods),
        more => Err(format!(
            "{more} methods, and {} keys: expected fewer",
            Panes::MOST
        )),
    }
}

impl ViewArgs {
    /// Opens the window, and returns when it is closed.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let renderer = renderer(Some(self.engine), Some(self.simd), Renderer::fastest())?;
        let watched = self.watch.then(|| Watched::new(&self.input)).transpose()?;
        if let Some(watched) = &watched {
            watched.begin();
        }
        let pool = self.threads.pool()?;
        warn_of_debug_build(log);
        // A scene that cannot be shown is said before a display that there is not.
        let loaded = pool.install(|| self.load(log))?;
        let panes = Panes::new(self.methods.clone());
        let name = scene_name(&self.input);
        let viewer = Viewer::new(loaded, name, panes, renderer)?;
        let reload = watched.map(|watched| {
            let (args, threads) = (self.clone(), self.threads);
            // The file may become anything: it was one when the window opened, and is waited for.
            move || {
                watched.wait(log, "Esc in the window");
                watched.begin();
                threads.install(|| args.load(log))?
            }
        });
        window::show(viewer, pool, reload, || {
            let methods = self.methods.iter().enumerate();
            let methods: Vec<_> = methods.map(|(n, m)| format!("{} {m}", n + 1)).collect();
            log.note(&format!(
                "{}: {}\n{}",
                name,
                methods.join(", "),
                Action::KEYS
            ));
        })?;
        Ok(Outcome::Done)
    }

    /// Loads and prepares the scene.
    fn load(&self, log: Log) -> Result<Loaded, CliError> {
        let mut file = self.scene.load_to_show(&self.input)?;
        let resolved = self.scene.resolve_to_show(&mut file)?;
        self.scene.warn(&file, &resolved, log);
        self.scene.note_colours(&file, &resolved, log);
        memory::check_frame(&resolved.scene)?;
        let camera = file.table().table("camera");
        let gives = |key| camera.is_some_and(|camera| camera.get(key).is_some());
        let loaded = Loaded::new(&resolved.scene, [gives("near"), gives("far")])?;
        warn_of_polygons_left_out(&loaded.frame()?, log);
        Ok(loaded)
    }
}
