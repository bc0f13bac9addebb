//! The search for the mistake, or the two or three, that explain how a picture differs.

use super::amounts::{Amounts, Tone};
use super::drawer::Drawer;
use super::mistakes::{MISTAKES, Mistake, methods};
use super::recipe::{Cut, Interpolated, Place, Rate, Recipe};
use super::residual::{MOST, Residual, Target, Votes, apart};
use alloc::vec;
use alloc::vec::Vec;
use fastphong::scene::Scene;

/// The largest residual of an exact explanation, in levels: only rounding is left.
const EXACT: f64 = 0.02;

/// The largest residual of an explanation, in levels: noise of a level or another rounding may be
/// left.
const NEAR: f64 = 0.6;

/// The largest [`Residual::beyond`] of an explanation. A picture that no mistake explains is right
/// if it is this close.
const NOISE: f64 = 0.1;

/// A picture that is farther from the reference than this, in levels, is not another method's
/// picture.
const FAR_FROM_METHODS: f64 = 12.0;

/// A mistake that changes a picture by less than this, in levels, is invisible in it.
pub const INVISIBLE: f64 = 0.004;

/// How many of the best single mistakes are combined with others.
const FIRST_OF_PAIRS: usize = 4;

/// Some mistakes, and the residual that they leave.
#[derive(Clone)]
pub struct Candidate {
    /// The mistakes, as indices into [`Search::mistakes`].
    pub mistakes: Vec<usize>,
    pub recipe: Recipe,
    pub residual: Residual,
}

/// A search in one picture.
pub struct Search<'a, 'd> {
    pub scene: &'a Scene,
    pub drawer: &'d mut Drawer<'a>,
    pub target: &'d Target,
    pub mistakes: Vec<Mistake>,
    /// How far each mistake of the table changes the scene's picture, in levels, or `None` if it is
    /// not a mistake here.
    pub shown: Vec<Option<f64>>,
    /// The right recipe, with the cut of polygons that comes closest.
    pub base: Recipe,
    pub reference: Residual,
}

/// The result of a search.
pub struct Findings {
    pub verdict: Verdict,
    /// The mistakes to name: the best ones, then others that explain the picture as well.
    pub causes: Vec<Candidate>,
    /// Single mistakes, the best first.
    pub singles: Vec<Candidate>,
    pub votes: Option<Votes>,
    pub amounts: Option<Amounts>,
    pub tone: Option<Tone>,
}

/// The kind of answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// The picture is right.
    Correct,
    /// One mistake explains the picture.
    One,
    /// Several mistakes together explain it.
    Several,
    /// Wrong amounts of light explain it.
    Amounts,
    /// A tone curve explains it: its levels are a function of the right ones.
    Tone,
    /// A mistake explains most of it.
    Partly,
    /// No known mistake explains it.
    None,
    /// The picture shows nothing.
    Empty,
}

impl Verdict {
    /// Returns its name in data.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Correct => "correct",
            Verdict::One => "one",
            Verdict::Several => "several",
            Verdict::Amounts => "amounts",
            Verdict::Tone => "tone",
            Verdict::Partly => "partly",
            Verdict::None => "none",
            Verdict::Empty => "empty",
        }
    }
}

impl Residual {
    /// True if nothing is left but rounding.
    fn is_nothing(&self) -> bool {
        self.levels <= EXACT
    }

    /// True if only noise or another rounding is left.
    fn is_small(&self) -> bool {
        self.levels <= NEAR || self.beyond <= NOISE
    }

    /// True if another mistake may be left: more than rounding and noise of a level.
    fn is_worth_explaining(&self) -> bool {
        self.levels > 3.0 * EXACT && self.beyond > EXACT
    }
}

/// True if a mistake explains the residual `before` and leaves `after`: nearly nothing, or nearly
/// nothing beyond noise of a level.
fn explains(after: Residual, before: Residual) -> bool {
    let nearly = |after: f64, before: f64, near: f64| {
        after <= near.max(0.08 * before) && after <= 0.3 * before
    };
    let is_noise_apart = before.beyond > EXACT && nearly(after.beyond, before.beyond, NOISE);
    nearly(after.levels, before.levels, NEAR) || is_noise_apart
}

/// Returns the largest residual that is as good as `best`.
fn as_good_as(best: f64) -> f64 {
    best + (0.3 * best).max(EXACT)
}

/// The harmless ways to interpolate over polygons of more than three sides.
const CUTS: [Cut; 4] = [Cut::Whole, Cut::Fan, Cut::OtherFan, Cut::Shorter];

fn with_cut(mut recipe: Recipe, cut: Cut) -> Recipe {
    recipe.geometry.cut = cut;
    recipe
}

impl<'a, 'd> Search<'a, 'd> {
    /// Begins a search. `right` are the right recipes, which are all equally good. Returns `None`
    /// if too little of the scene is visible.
    pub fn new(
        scene: &'a Scene,
        drawer: &'d mut Drawer<'a>,
        target: &'d Target,
        right: &[Recipe],
    ) -> Option<Search<'a, 'd>> {
        let mut best: Option<(Recipe, Residual)> = None;
        for recipe in right
            .iter()
            .flat_map(|right| CUTS.map(|cut| with_cut(*right, cut)))
        {
            let drawn = drawer.draw(&recipe);
            let found = drawn.and_then(|drawn| target.residual(&drawn));
            let Some(found) = found else { continue };
            // Prefer the first cut unless another one is clearly closer.
            if best.is_none_or(|(_, best)| found.levels < 0.99 * best.levels) {
                best = Some((recipe, found));
            }
        }
        let (base, reference) = best?;
        Some(Search {
            scene,
            drawer,
            target,
            mistakes: MISTAKES.to_vec(),
            shown: Vec::new(),
            base,
            reference,
        })
    }

    /// Looks for an explanation. `progress` is called with the share of the work that is done, 0
    /// to 1.
    pub fn run(mut self, progress: &mut dyn FnMut(f32)) -> (Findings, Search<'a, 'd>) {
        self.shown = self.shown();
        if self.reference.is_nothing() {
            return (self.correct(Vec::new()), self);
        }
        let mut singles = self.singles(0..MISTAKES.len(), progress);
        if singles
            .first()
            .is_none_or(|best| best.residual.beyond > EXACT)
            && self.reference.levels <= FAR_FROM_METHODS
        {
            let from = self.mistakes.len();
            self.mistakes.extend(methods());
            let by_methods = self.singles(from..self.mistakes.len(), &mut |_| {});
            singles.extend(by_methods);
            sort(&mut singles);
        }
        progress(0.6);
        let findings = self.judge(singles, progress);
        (findings, self)
    }

    fn correct(&self, singles: Vec<Candidate>) -> Findings {
        Findings {
            verdict: Verdict::Correct,
            causes: Vec::new(),
            singles,
            votes: None,
            amounts: None,
            tone: None,
        }
    }

    fn judge(&mut self, singles: Vec<Candidate>, progress: &mut dyn FnMut(f32)) -> Findings {
        let before = self.reference;
        let Some(best) = singles.first().cloned() else {
            return self.correct(singles);
        };
        let votes = self.votes(&best);
        let is_exact = best.residual.is_nothing();
        // If all differences are within a level they are noise, unless a mistake leaves nothing at
        // all.
        let is_noise = before.beyond <= EXACT && !is_exact;
        // Votes decide about highlights and other small parts, which change the mean only a little.
        let is_small = best.residual.levels <= 2.0 * NEAR;
        let is_elected = is_small && votes.is_some_and(|votes| votes.elect());
        let is_one = (explains(best.residual, before) || is_elected) && !is_noise;
        let mut findings = Findings {
            votes,
            ..self.correct(singles)
        };
        if is_one {
            findings.verdict = Verdict::One;
            findings.causes = tied(&findings.singles);
        } else if before.beyond <= NOISE {
            return findings;
        } else {
            findings.verdict = Verdict::None;
        }
        if best.residual.is_worth_explaining() {
            self.several(&mut findings, progress);
        }
        if findings.verdict == Verdict::One && !findings.causes[0].residual.is_small() {
            findings.verdict = Verdict::Partly;
        }
        let left = findings
            .causes
            .first()
            .map_or(before, |cause| cause.residual)
            .levels;
        if left > 0.1 {
            self.amounts(&mut findings, left);
        }
        if findings.verdict == Verdict::None && best.residual.levels < 0.3 * before.levels {
            findings.verdict = Verdict::Partly;
            findings.causes = tied(&findings.singles);
        }
        findings
    }

    /// Returns the single mistakes at the indices `which` with their residuals, the best first.
    fn singles(
        &mut self,
        which: core::ops::Range<usize>,
        progress: &mut dyn FnMut(f32),
    ) -> Vec<Candidate> {
        let count = which.len().max(1) as f32;
        let first = which.start;
        let mut found = Vec::new();
        for index in which {
            let candidate = self.candidate(vec![index], self.base);
            found.extend(candidate);
            progress(0.5 * (index - first) as f32 / count);
        }
        sort(&mut found);
        // Where light depends on the cut of polygons, try all cuts.
        for (place, candidate) in found.iter_mut().enumerate() {
            if place < 8 || depends_on_cut(&candidate.recipe) {
                *candidate = self.with_any_cut(candidate.clone());
            }
        }
        sort(&mut found);
        found
    }

    /// Returns a candidate's mistakes with the cut of polygons that leaves the least.
    fn with_any_cut(&mut self, candidate: Candidate) -> Candidate {
        let mut best = candidate;
        for cut in CUTS {
            let other = self.candidate(best.mistakes.clone(), with_cut(self.base, cut));
            if let Some(other) = other
                && other.residual.levels < best.residual.levels
            {
                best = other;
            }
        }
        best
    }

    fn candidate(&mut self, mistakes: Vec<usize>, base: Recipe) -> Option<Candidate> {
        let made: Vec<&Mistake> = mistakes.iter().map(|&m| &self.mistakes[m]).collect();
        let recipe = Mistake::all(&made, base, self.scene)?;
        let drawn = self.drawer.draw(&recipe)?;
        let residual = self.target.residual(&drawn)?;
        Some(Candidate {
            mistakes,
            recipe,
            residual,
        })
    }

    fn votes(&mut self, candidate: &Candidate) -> Option<Votes> {
        let reference = self.drawer.draw(&self.base)?;
        let other = self.drawer.draw(&candidate.recipe)?;
        Some(self.target.votes(&reference, &other))
    }

    /// Looks for two or three mistakes that together leave less than one.
    fn several(&mut self, findings: &mut Findings, progress: &mut dyn FnMut(f32)) {
        let before = self.reference;
        self.drawer.keep_light();
        let mut best = findings.singles[0].residual;
        // If two mistakes concern different things, each of them removes some of the difference on
        // its own.
        let helps = |single: &&Candidate| single.residual.levels < 0.95 * before.levels;
        let helping = findings.singles.iter().filter(helps);
        let mut from: Vec<Candidate> = helping.take(FIRST_OF_PAIRS).cloned().collect();
        if findings.verdict == Verdict::None {
            from.extend(self.of_whole_picture(findings));
        }
        for more in 0..2 {
            let together = self.with_one_more(&from, &mut |share| {
                progress(0.6 + 0.2 * (more as f32 + share));
            });
            let Some(first) = together.first() else {
                return;
            };
            let left = first.residual;
            let is_open = matches!(findings.verdict, Verdict::None) && more == 0;
            let is_near = left.levels <= NEAR.max(0.08 * before.levels) || left.beyond <= NOISE;
            let is_half = left.levels <= 0.5 * before.levels || left.beyond <= 0.5 * before.beyond;
            let is_better = explains(left, best) || is_open && is_near && is_half;
            if !is_better {
                return;
            }
            findings.verdict = Verdict::Several;
            findings.causes = tied(&together);
            best = left;
            if !left.is_worth_explaining() {
                return;
            }
            from = together;
            from.truncate(2);
        }
    }

    /// Returns the single mistakes that change the whole picture so much that they hide all others:
    /// it is mirrored, or stored in another way.
    fn of_whole_picture(&self, findings: &Findings) -> Vec<Candidate> {
        let is_whole = |single: &&Candidate| {
            let recipe = &single.recipe;
            let is_turned = matches!(
                recipe.place,
                Place::MirroredX | Place::MirroredY | Place::Turned | Place::Transposed
            );
            let (own, right) = (recipe.storage, self.base.storage);
            is_turned || own.curve != right.curve || own.channels != right.channels
        };
        let first = findings.singles.iter().skip(FIRST_OF_PAIRS);
        first.filter(is_whole).cloned().collect()
    }

    /// Adds each mistake of the table to each candidate. Returns the results, the best first.
    fn with_one_more(
        &mut self,
        from: &[Candidate],
        progress: &mut dyn FnMut(f32),
    ) -> Vec<Candidate> {
        let mut found: Vec<Candidate> = Vec::new();
        for (place, candidate) in from.iter().enumerate() {
            progress(place as f32 / from.len() as f32);
            for another in 0..MISTAKES.len() {
                let mut mistakes = candidate.mistakes.clone();
                mistakes.push(another);
                let mut sorted = mistakes.clone();
                sorted.sort_unstable();
                let is_known = found.iter().any(|other| {
                    let mut other = other.mistakes.clone();
                    other.sort_unstable();
                    other == sorted
                });
                // Other geometry takes long to draw: combine it only with the best candidates.
                let is_shown = self.shown[another].is_some_and(|levels| levels >= INVISIBLE);
                let is_quick = place < FIRST_OF_PAIRS || self.keeps_geometry(another);
                if is_known || candidate.mistakes.contains(&another) || !is_quick || !is_shown {
                    continue;
                }
                let mut base = self.base;
                base.geometry.cut = match candidate.recipe.geometry.cut {
                    cut if CUTS.contains(&cut) => cut,
                    _ => base.geometry.cut,
                };
                let candidate = self.candidate(mistakes, base);
                found.extend(candidate.map(|candidate| {
                    if depends_on_cut(&candidate.recipe) {
                        self.with_any_cut(candidate)
                    } else {
                        candidate
                    }
                }));
            }
            self.drawer.forget_light();
        }
        sort(&mut found);
        for candidate in found.iter_mut().take(8) {
            *candidate = self.with_any_cut(candidate.clone());
        }
        sort(&mut found);
        found
    }

    fn keeps_geometry(&self, mistake: usize) -> bool {
        let mut recipe = self.base;
        self.mistakes[mistake].set(&mut recipe);
        recipe.geometry == self.base.geometry
    }

    /// Looks for wrong amounts of light and for a tone curve, if mistakes leave the residual
    /// `left`.
    fn amounts(&mut self, findings: &mut Findings, left: f64) {
        let encoding = self.scene.encoding;
        // Cuts matter only where colours are lit at vertices.
        let is_at_vertices = depends_on_cut(&self.base);
        let cuts = if is_at_vertices {
            &CUTS[..]
        } else {
            &[self.base.geometry.cut]
        };
        let by_cut: Vec<_> = cuts
            .iter()
            .map(|&cut| {
                let base = with_cut(self.base, cut);
                Amounts::find(self.drawer, &base, self.target, encoding)
            })
            .collect();
        let found = by_cut.into_iter().flatten();
        let amounts = found.min_by(|a, b| a.residual.total_cmp(&b.residual));
        if let Some(amounts) =
            amounts.filter(|amounts| amounts.is_possible() && amounts.residual <= 0.5 * left)
        {
            findings.amounts = Some(amounts);
            if amounts.residual <= NEAR || amounts.beyond <= NOISE {
                findings.verdict = Verdict::Amounts;
                findings.causes = Vec::new();
                return;
            }
        }
        let Some(reference) = self.drawer.draw(&self.base) else {
            return;
        };
        let inner = |i: &usize| reference.hits.is_covered(*i) && !reference.hits.edges[*i];
        let mut pairs: Vec<(f32, f32)> = (0..reference.levels.len())
            .filter(inner)
            .flat_map(|i| (0..3).map(move |c| (i, c)))
            .map(|(i, c)| (reference.levels[i][c], self.target.levels[i][c]))
            .collect();
        findings.tone = Tone::find(&mut pairs).filter(|tone| (tone.gamma - 1.0).abs() > 0.05);
        if let Some(tone) = findings.tone
            && findings.verdict == Verdict::None
            && tone.scatter <= 1.2
            && tone.scatter <= 0.2 * left
        {
            findings.verdict = Verdict::Tone;
        }
    }

    /// Returns how far each mistake of the table changes the picture of this scene, in levels, or
    /// `None` if it is not a mistake here.
    pub fn shown(&mut self) -> Vec<Option<f64>> {
        let Some(reference) = self.drawer.draw(&self.base) else {
            return vec![None; MISTAKES.len()];
        };
        let shown = |mistake: &Mistake| {
            let recipe = Mistake::all(&[mistake], self.base, self.scene)?;
            // A recipe that cannot be drawn is as far from the reference as possible.
            let drawn = self.drawer.draw(&recipe);
            Some(drawn.map_or(MOST, |drawn| apart(&reference, &drawn)))
        };
        MISTAKES.iter().map(shown).collect()
    }
}

/// True if light depends on the triangles that polygons are cut into.
fn depends_on_cut(recipe: &Recipe) -> bool {
    let is_at_pixels = matches!(recipe.shading.rate, Rate::Pixel | Rate::Method(_));
    !is_at_pixels || recipe.geometry.interpolation != Interpolated::Stated
}

fn sort(candidates: &mut [Candidate]) {
    candidates.sort_by(|a, b| a.residual.levels.total_cmp(&b.residual.levels));
}

/// Returns the candidates that explain a picture as well as the first and best of them.
fn tied(sorted: &[Candidate]) -> Vec<Candidate> {
    let best = sorted.first().map_or(0.0, |best| best.residual.levels);
    let most = as_good_as(best);
    let is_tied = |candidate: &&Candidate| candidate.residual.levels <= most;
    let mut tied: Vec<Candidate> = sorted.iter().take_while(is_tied).cloned().collect();
    // Among equal candidates the table's order decides: frequent mistakes come first there.
    let equal = tied.partition_point(|candidate| candidate.residual.levels <= best + 0.01);
    tied[..equal].sort_by_key(|candidate| (candidate.mistakes.len(), candidate.mistakes.clone()));
    tied
}
