//! `fastphong render`: draws the picture of an input.

use super::aov::{Aov, KINDS, Subject};
use super::drawing::RenderJob;
use super::engines::{self, EngineFlag, Simd, ThreadFlags, renderer};
use super::input_name;
use super::name_template::{named, scene_name};
use super::output::{self, ForceFlag, Output, print_beside};
use super::polygon_counts::stats_text;
use super::progress::Progress;
use super::reference_check::ReferenceCheck;
use super::scene_flags::{SceneFlags, note_frame, note_scene};
use super::tolerance::{Tolerance, ToleranceFlags};
use super::watch::watch;
use super::{CliError, Log, Outcome, files, memory, values};
use clap::ArgGroup;
use fastphong::drawing::Drawing;
use fastphong::frame::Frame;
use fastphong::notes::{Cost, of_polygons};
use fastphong::picture::image_file::Format;
use fastphong::raster::Renderer;
use fastphong::scene::file::STANDARD_INPUT;
use fastphong::scene::open::Look;
use fastphong::scene::{Scene, input};
use fastphong::shading::{METHODS, Variant};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::Instant;

/// Draw a scene or a mesh
#[derive(clap::Args, Debug)]
#[command(
    override_usage = "fastphong render [OPTIONS] --output <FILE> <INPUT>\n       \
                      fastphong render [OPTIONS] --reference <FILE> <INPUT>\n       \
                      fastphong render [OPTIONS] <--stats|--print-scene> <INPUT>",
    group = ArgGroup::new("picture").args(["output", "reference"]).multiple(true)
)]
pub struct RenderArgs {
    /// Scene file, mesh file, builtin:NAME?key=value, name of a shipped scene, or `-` for standard
    /// input
    #[arg(value_parser = input_name::parser())]
    input: String,
    /// Picture file: .png, .ppm or .pfm (linear floats); `-` is standard output. `{scene}`,
    /// `{method}`, `{engine}`, `{width}` and `{height}` in the name are replaced
    #[arg(short, long, value_name = "FILE", required_unless_present_any = ["print_scene", "reference", "stats"])]
    output: Option<PathBuf>,
    /// Format of the picture, whatever the file's ending [default: by the ending, png on standard
    /// output]
    #[arg(long, value_name = "png|ppm|pfm", value_parser = output::format, requires = "output")]
    format: Option<Format>,
    /// Shading method, with parameters as in `fast-phong:steps=1`; see `fastphong list methods`.
    /// `auto` chooses the fastest method with naive Phong's picture; `fastphong info` shows which
    /// one that is. `reference` draws the f64 closed form of Phong shading, or of another model
    /// with `reference:model=flat|gouraud|phong|slerp`
    #[arg(short, long, default_value = Drawing::AUTO, value_parser = Drawing::from_str, requires = "picture")]
    method: Drawing,
    /// Engine that finds the pixels: `span`, as in the lecture, one pixel at a time; `row`, with
    /// SIMD; `auto`, which is `row` if it can draw the scene, else `span`; `barycentric`, also with
    /// `:edges=top-left|closed`; or `cs171`, also with `:normals=unit|as-printed`. See
    /// `fastphong list engines`
    #[arg(long, default_value = "auto", value_parser = engines::engine, requires = "picture")]
    engine: EngineFlag,
    /// Instruction set of the pixel loops: `auto` (the best on this machine) or one of
    /// `fastphong list simd`. `scalar` selects the span engine (one thread, the same bytes on every
    /// platform), any other the row engine
    #[arg(long, value_name = "ISA", default_value = "auto", value_parser = engines::simd, requires = "picture")]
    simd: Simd,
    #[command(flatten)]
    threads: ThreadFlags,
    /// Show a quantity other than colour
    #[arg(long, value_enum, conflicts_with_all = ["engine", "simd"])]
    aov: Option<Aov>,
    /// Side of a square of `--aov checkerboard`, in world units [default: 1]
    #[arg(long, value_name = "UNITS", value_parser = values::length, allow_hyphen_values = true, requires = "aov", conflicts_with_all = ["engine", "simd"])]
    square: Option<f64>,
    /// Print the scene, flags included, as a scene file
    #[arg(long)]
    print_scene: bool,
    /// Print how many polygons are culled, clipped and drawn
    #[arg(long)]
    stats: bool,
    /// Compare the picture with FILE; if they differ, exit with code 1 and write the picture and a
    /// map of the difference beside FILE
    #[arg(long, value_name = "FILE", visible_alias = "ref")]
    reference: Option<PathBuf>,
    /// How many grey levels (of 255) a channel may differ from the reference. Alpha is a channel: a
    /// pixel that only one picture covers differs by its alpha
    #[arg(long, value_name = "GREY_LEVELS", default_value = "1", value_parser = values::grey_levels, allow_hyphen_values = true, requires = "reference", visible_alias = "ref-threshold")]
    reference_threshold: f64,
    #[command(flatten)]
    tolerance: ToleranceFlags,
    /// Draw again whenever a file of the scene changes, until Ctrl-C
    #[arg(long)]
    watch: bool,
    #[command(flatten)]
    force: ForceFlag,
    #[command(flatten)]
    scene: SceneFlags,
}

impl RenderArgs {
    /// Draws the picture, once or with `--watch` again and again.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let draw = || self.threads.install(|| self.draw(log))?;
        if self.watch {
            watch(&self.input, log, draw)
        } else {
            draw()
        }
    }

    /// Loads the scene, then draws, writes and compares the picture.
    fn draw(&self, log: Log) -> Result<Outcome, CliError> {
        if let (Some(aov), Some(_)) = (self.aov.filter(|a| *a != Aov::Checkerboard), self.square) {
            let problem = format!("`--square` is for squares, not for `--aov {}`", aov.name());
            return Err(format!("{problem}: expected `--aov checkerboard`").into());
        }
        let mut output = self.output()?;
        let tolerance = self.tolerance()?;
        let beside: Vec<Output> = output.iter().cloned().collect();
        let beside: Vec<&Output> = beside.iter().collect();
        let renderer = match self.engine {
            EngineFlag::Scanlines(engine) => {
                renderer(Some(engine), Some(self.simd), Renderer::fastest())?
            }
            EngineFlag::Barycentric(_) | EngineFlag::Cs171 { .. } => Renderer::LECTURE,
        };
        let file = self.scene.read(&self.input)?;
        let progress = Progress::watched(log);
        progress.at(0.0, "loading");
        let started = Instant::now();
        let look = if self.aov.is_none() {
            Look::Shown
        } else {
            Look::Compared
        };
        let mut opened = self.scene.open_file(file, look)?;
        if self.aov.is_some() && std::mem::replace(&mut opened.scene.samples, 1) > 1 {
            // The mean of several depths, normals or polygon indices has no meaning.
            progress.aside(|| {
                log.note("--aov shows a single sample per pixel, in its middle (--samples 1)")
            });
        }
        if self.aov == Some(Aov::Colours) {
            opened.notes.remove("colours-unused");
        }
        progress.aside(|| {
            note_scene(&opened, log);
            if self.aov == Some(Aov::Colours) {
                note_no_colours(&opened.scene, log);
            }
            log.duration("loaded", started);
        });
        if self.print_scene {
            let mut file = opened.file.clone();
            input::make_paths_relative_to_current_folder(&mut file);
            progress.aside(|| {
                if file.meshes().any(|mesh| mesh == STANDARD_INPUT) {
                    let there = "`mesh = \"-\"` reads the mesh from standard input again";
                    log.note(&format!(
                        "{there}: replace `-` by the name of a file to avoid that"
                    ));
                }
                if let Some(mesh) = file.meshes().find(|mesh| input_name::is_stand_in(mesh)) {
                    let problem = "is not the name of a file: a scene file holds text in UTF-8";
                    log.warning(&format!(
                        "`mesh = {mesh:?}` {problem}, and the path is not UTF-8"
                    ));
                }
                print_beside(&beside, &file.to_toml())
            })?;
        }
        if output.is_none() && self.reference.is_none() && !self.stats {
            return Ok(Outcome::Done);
        }
        progress.at(0.25, "projecting");
        let started = Instant::now();
        memory::check_frame(&opened.scene)?;
        let frame = opened.scene.frame()?;
        progress.aside(|| {
            log.duration("projected", started);
            match self.aov {
                None => note_frame(&opened, &frame, log),
                // Other quantities have no light.
                Some(aov) => {
                    log.notes(&of_polygons(&frame, Cost::Samples));
                    let shown = format!("--aov {}", aov.name());
                    log.notes(&self.scene.unused(&shown, &aov.unused_flags()));
                }
            }
            if self.stats {
                return print_beside(&beside, &stats_text(&frame));
            }
            log.detail(stats_text(&frame).trim_end());
            Ok(())
        })?;
        progress.at(0.5, "shading");
        let mut job = progress.aside(|| {
            let mut job = self.job(frame, renderer, log)?;
            job.opaque = opened.file.is_opaque();
            let asked = matches!(self.engine, EngineFlag::Scanlines(Some(_)));
            job.log(asked || self.simd.is_some(), self.threads.threads, log);
            Ok::<_, CliError>(job)
        })?;
        if let Some(output) = &mut output {
            self.name(output, &job)?;
        }
        let check = tolerance
            .as_ref()
            .map(|(reference, tolerance)| ReferenceCheck {
                reference,
                tolerance,
                written: output.as_ref(),
                force: self.force,
            });
        if let Some((_, tolerance)) = &tolerance {
            tolerance.selection(job.size())?;
        }
        let others = check.as_ref().map(ReferenceCheck::outputs).transpose()?;
        let others = others.unwrap_or_default();
        output::check(&output.iter().chain(&others).collect::<Vec<_>>())?;
        let formats = [
            output.as_ref().and_then(Output::format),
            self.reference_format(),
        ];
        let [written, compared] = formats;
        let has_alpha = formats.iter().flatten().any(|f| *f == Format::Png);
        if !has_alpha && formats.iter().any(Option::is_some) {
            let shown = "PPM and PFM files, which have no alpha";
            progress.aside(|| log.notes(&self.scene.unused(shown, &["alpha"])));
        }
        memory::check_picture(&job, written, compared)?;
        if let Some(output) = &output {
            write(&mut job, output, &progress, log)?;
        }
        let Some(check) = check else {
            return Ok(Outcome::Done);
        };
        let warn = |text: &str| progress.aside(|| log.warning(text));
        let (outcome, text) = check.run(&mut job, &warn)?;
        progress.aside(|| print_beside(&beside, &text))?;
        Ok(outcome)
    }

    /// Returns the reference, and the tolerance of the comparison with it; `None` without
    /// `--reference`.
    ///
    /// # Errors
    /// If a flag of the tolerance is used without a reference, or the mask cannot be read.
    fn tolerance(&self) -> Result<Option<(&Path, Tolerance<'_>)>, CliError> {
        let Some(reference) = self.reference.as_deref() else {
            return match self.tolerance.first_given() {
                None => Ok(None),
                Some(flag) => {
                    let problem = format!("`{flag}` is for a comparison, but there is none");
                    Err(format!("{problem}: expected `--reference FILE` too").into())
                }
            };
        };
        let threshold = Some(self.reference_threshold);
        let tolerance = self.tolerance.with(threshold, "--reference-threshold")?;
        Ok(Some((reference, tolerance)))
    }

    /// Returns the format of the reference. [`RenderArgs::output`] has checked that its ending
    /// names one.
    fn reference_format(&self) -> Option<Format> {
        let reference = self.reference.as_deref();
        reference.and_then(|path| Format::of_path(path).ok())
    }

    /// Returns the destination of the picture.
    fn output(&self) -> Result<Option<Output>, CliError> {
        if let Some(reference) = &self.reference {
            Format::of_path(reference)?;
            files::will_read(reference, "the reference");
        }
        let Some(path) = &self.output else {
            return Ok(None);
        };
        // Report wrong placeholders before anything is drawn.
        named(path, Default::default())?;
        Output::of_picture(path, self.format).map(Some)
    }

    /// Replaces the placeholders in the name of the picture.
    fn name(&self, output: &mut Output, job: &RenderJob) -> Result<(), CliError> {
        let Some(path) = output.path_mut() else {
            return Ok(());
        };
        let [width, height] = job.size().map(|side| side.to_string());
        let scene = scene_name(&self.input);
        *path = named(path, [scene, &job.name, job.engine(), &width, &height])?;
        Ok(())
    }

    /// Returns the method whose kinds are shown.
    ///
    /// # Errors
    /// If `--method` is set for a quantity that no method changes, or the method has only one kind
    /// of polygons.
    fn method_of(&self, aov: Aov) -> Result<Variant, CliError> {
        match &self.method {
            Drawing::Auto => Ok(Variant::parse("adaptive-phong")?),
            _ if aov != Aov::Kind => {
                Err(format!("--aov {} cannot be used with --method", aov.name()).into())
            }
            Drawing::Variant(variant) if !variant.row().kinds().is_empty() => Ok(variant.clone()),
            method => {
                let all = METHODS.iter().filter(|entry| !entry.kinds().is_empty());
                let names: Vec<&str> = all.map(|entry| entry.info.name).collect();
                let names = names.join(", ");
                Err(format!(
                    "--aov kind: {method} has only one kind of polygons: expected one of {names}"
                )
                .into())
            }
        }
    }

    /// Makes the job that draws `frame`, and logs which method `auto` chose.
    fn job(&self, frame: Frame, renderer: Renderer, log: Log) -> Result<RenderJob, CliError> {
        if let Some(aov) = self.aov {
            let subject = Subject {
                square: self.square.unwrap_or(1.0),
                variant: self.method_of(aov)?,
            };
            if aov == Aov::Kind {
                log.note(&kinds_text(&subject.variant, &frame));
            }
            return Ok(RenderJob::aov(frame, aov, subject));
        }
        let method = if self.method == Drawing::Auto {
            let (variant, why) = match self.engine {
                EngineFlag::Cs171 { .. } => {
                    let variant = Variant::parse("naive-phong").expect("a method of the table");
                    (variant, "the only method of CS171 that lights each pixel")
                }
                _ => Variant::auto(&frame, renderer),
            };
            log.detail(&format!(
                "method {variant}, chosen by {}: {why}",
                Drawing::AUTO
            ));
            Drawing::Variant(variant)
        } else {
            self.method.clone()
        };
        RenderJob::shaded(frame, &method, self.engine, self.simd, renderer, log)
    }
}

/// Notes which meshes have no vertex colours for `--aov colours`.
fn note_no_colours(scene: &Scene, log: Log) {
    let objects = scene.objects.iter();
    let without = objects.filter(|object| object.mesh.colours().is_empty());
    let names: BTreeSet<&str> = without.map(|object| &*object.name).collect();
    for name in names {
        let text = "has no vertex colours: --aov colours shows it in white";
        log.note(&format!("{name}: {text}"));
    }
}

/// Returns a line on the kinds of a method: how many polygons each draws, and its colour in
/// `--aov kind`.
fn kinds_text(variant: &Variant, frame: &Frame) -> String {
    let kinds = variant.polygon_kinds(frame);
    let kinds: Vec<String> = kinds
        .iter()
        .zip(KINDS)
        .map(|(kind, (colour, _))| format!("{} {} ({colour})", kind.polygons, kind.name))
        .collect();
    format!("{variant}: polygons by kind: {}", kinds.join(", "))
}

/// Writes the picture and logs its name and size.
fn write(
    job: &mut RenderJob,
    output: &Output,
    progress: &Progress,
    log: Log,
) -> Result<(), CliError> {
    let started = Instant::now();
    let format = output.format().expect("an output of a picture");
    if format == Format::Ppm {
        output.write(|out| job.write_ppm(out))?;
        progress.aside(|| log.duration("shaded and written", started));
    } else {
        let picture = job.picture(format);
        progress.aside(|| log.duration("shaded", started));
        progress.at(0.75, "writing");
        output.write_encoded(&picture)?;
    }
    if let Some(path) = output.path() {
        let ([width, height], path, shown) = (job.size(), path.display(), &job.name);
        progress.aside(|| log.note(&format!("{path}: {width}x{height}, {shown}")));
    }
    Ok(())
}
