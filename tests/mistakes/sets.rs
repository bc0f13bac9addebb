//! `fastphong diagnose` explains pictures of several mistakes at once.
//!
//! Programs as people write them have three to five mistakes. Each set here is random: a scene, and
//! mistakes of [`MISTAKES`] that `diagnose` knows, each of which shows beside the others. A usual
//! run takes one pair and one triple, in small pictures. This command takes 60 pairs, triples and
//! quadruples, of other random numbers, and prints a line for each:
//!
//! ```sh
//! FASTPHONG_SETS=60 FASTPHONG_SETS_SEED=100 \
//!     cargo test --release --test mistakes sets -- --nocapture
//! ```
//!
//! The seeds 1 to 9 are for development: limits of the search may be chosen on them. The seeds from
//! 100 on are for counting.
//!
//! Two answers with other names may both be true: without diffuse and specular light there is no
//! light. So this renderer decides. It draws what the answer names, and compares the pictures.

use crate::draw::draw;
use crate::mistakes::{MISTAKES, Mistake, can_be_combined};
use crate::named::{Random, diagnosed, names, said};
use crate::picture::Picture;
use crate::scenes::scenes;
use crate::variation::Variation;
use fastphong::scene::Scene;
use fastphong_cli::diagnose::{Cause, Diagnosis, Verdict};
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Worth {
    /// The first explanation has all mistakes, and nothing else.
    Exact,
    /// Another explanation that is as good has them.
    Or,
    /// It is said that something is left, and the mistakes that are named are there.
    Part,
    /// No mistake is named, and the picture is not said to be right.
    None,
    /// A mistake is named that is not there, or one that shows is left out and nothing is said to
    /// be left.
    Untrue,
}

/// The mean difference of two pictures over the pixels that either covers, in levels: the sum of
/// all four channels, divided by 3.
fn distance(a: &Picture, b: &Picture) -> f64 {
    let (mut sum, mut count) = (0, 0);
    for (a, b) in a.pixels.iter().zip(&b.pixels) {
        if a[3] != 0 || b[3] != 0 {
            count += 1;
            sum += (0..4).map(|c| u64::from(a[c].abs_diff(b[c]))).sum::<u64>();
        }
    }
    sum as f64 / 3.0 / f64::from(count.max(1))
}

/// A mistake shows if the picture without it is farther away than this, in levels.
const SHOWS: f64 = 0.15;

/// Two sets of mistakes mean the same in a scene if their pictures are no farther apart than this,
/// in levels.
const SAME: f64 = 0.05;

/// A picture of several mistakes.
struct Case<'a> {
    scene: &'a Scene,
    set: Vec<&'static Mistake>,
    picture: Picture,
}

fn drawn(scene: &Scene, mistakes: &[&Mistake]) -> Picture {
    draw(scene, mistakes, &Variation::default())
}

/// Returns `mistakes` without the one at `index`.
fn without<'a>(mistakes: &[&'a Mistake], index: usize) -> Vec<&'a Mistake> {
    let mut rest = mistakes.to_vec();
    rest.remove(index);
    rest
}

fn can_all_be_combined(set: &[&Mistake]) -> bool {
    (0..set.len()).all(|i| (0..i).all(|j| can_be_combined(set[i], set[j])))
}

impl<'a> Case<'a> {
    /// Takes a random set of `size` mistakes. Returns `None` if they cannot be combined, if one
    /// does not show, or if little of the object is left to see.
    fn random(scene: &'a Scene, size: usize, random: &mut Random) -> Option<Case<'a>> {
        let mut one = || &MISTAKES[random.below(MISTAKES.len() as u64) as usize];
        let set: Vec<&Mistake> = (0..size).map(|_| one()).collect();
        if set.iter().any(|mistake| names(mistake.id).is_empty()) || !can_all_be_combined(&set) {
            return None;
        }
        let (picture, right) = (drawn(scene, &set), drawn(scene, &[]));
        let covered = |p: &Picture| p.pixels.iter().filter(|pixel| pixel[3] != 0).count();
        let all_show = || {
            let rest = |index| drawn(scene, &without(&set, index));
            (0..size).all(|index| distance(&picture, &rest(index)) > SHOWS)
        };
        let is_case = covered(&picture) * 8 >= covered(&right)
            && distance(&picture, &right) > SHOWS
            && all_show();
        is_case.then_some(Case {
            scene,
            set,
            picture,
        })
    }

    /// Returns what an answer is worth.
    fn worth(&self, answer: &Diagnosis) -> Worth {
        let all_are_at = |steps: &[&str]| self.set.iter().all(|m| steps.contains(&m.step));
        let causes = &answer.causes;
        match answer.verdict {
            Verdict::One | Verdict::Several => match causes.iter().position(|c| self.is_exact(c)) {
                Some(0) => Worth::Exact,
                Some(_) => Worth::Or,
                None => Worth::Untrue,
            },
            Verdict::Partly if causes.iter().any(|cause| self.is_part(cause)) => Worth::Part,
            // Amounts of light and curves of levels name no mistake, but say what kind there is.
            Verdict::Amounts if self.is_counted(answer) => Worth::Part,
            Verdict::Tone if all_are_at(&LEVELS) => Worth::Part,
            Verdict::None | Verdict::Empty => Worth::None,
            _ => Worth::Untrue,
        }
    }

    /// True if all mistakes besides some numbers are of the set, and the numbers stand for the
    /// others.
    fn is_counted(&self, answer: &Diagnosis) -> bool {
        let Some(numbers) = &answer.numbers else {
            return false;
        };
        let named = |t: &Mistake| {
            numbers
                .mistakes
                .iter()
                .any(|m| names(t.id).contains(&&*m.id))
        };
        let is_light = |step: &str| !numbers.lights.is_empty() && step.starts_with("light_");
        let is_exponent = |step: &str| (numbers.exponent - 1.0).abs() > 0.03 && step == "exponent";
        let is_number = |step: &str| {
            AMOUNTS.contains(&step) || step == "channels" || is_light(step) || is_exponent(step)
        };
        let of_set = |m: &fastphong_cli::diagnose::Mistake| {
            self.set.iter().any(|t| names(t.id).contains(&&*m.id))
        };
        numbers.mistakes.iter().all(of_set)
            && self.set.iter().all(|t| named(t) || is_number(t.step))
    }

    /// True if a cause has the mistakes of the set and no others, by their names or because it
    /// draws the same picture.
    fn is_exact(&self, cause: &Cause) -> bool {
        let has = |mistake: &&Mistake| {
            let names = names(mistake.id);
            cause.mistakes.iter().any(|m| names.contains(&&*m.id))
        };
        self.is_of_set(cause) && self.set.iter().all(has)
            || meanings(cause).iter().any(|claim| self.is_rest(claim, &[]))
    }

    /// True if a cause has some mistakes of the set and no others, by their names or because it
    /// draws the same picture together with others of the set.
    fn is_part(&self, cause: &Cause) -> bool {
        let all = 0..1_u32 << self.set.len();
        let part = |bits: u32| -> Vec<&Mistake> {
            let set = self.set.iter().enumerate();
            set.filter(|(i, _)| bits >> i & 1 == 1)
                .map(|(_, m)| *m)
                .collect()
        };
        let is_meant = |claim: &Vec<&Mistake>| {
            let mut parts = all.clone().map(part);
            parts.any(|rest| self.is_rest(claim, &rest))
        };
        self.is_of_set(cause) || meanings(cause).iter().any(is_meant)
    }

    /// True if each mistake of a cause is one of the set, by its names.
    fn is_of_set(&self, cause: &Cause) -> bool {
        let mut of_cause = cause.mistakes.iter();
        of_cause.all(|m| self.set.iter().any(|t| names(t.id).contains(&&*m.id)))
    }

    /// True if the mistakes of `claim` and `rest` draw the picture, and each of `claim` is needed
    /// for that.
    fn is_rest(&self, claim: &[&Mistake], rest: &[&Mistake]) -> bool {
        let all = [claim, rest].concat();
        let is_same =
            |mistakes: &[&Mistake]| distance(&drawn(self.scene, mistakes), &self.picture) <= SAME;
        can_all_be_combined(&all)
            && is_same(&all)
            && (0..claim.len()).all(|index| !is_same(&without(&all, index)))
    }
}

/// The steps whose mistakes change amounts of light.
const AMOUNTS: [&str; 8] = [
    "coefficients",
    "materials",
    "light_colour",
    "lights",
    "ambient",
    "diffuse_term",
    "specular_term",
    "specular_colour",
];

/// The steps whose mistakes change levels alone.
const LEVELS: [&str; 3] = ["encoding", "rounding", "overflow"];

/// Returns the sets of this renderer's mistakes that a cause may mean: none if it has a mistake
/// that is not in the table.
fn meanings(cause: &Cause) -> Vec<Vec<&'static Mistake>> {
    let mut all = vec![Vec::new()];
    for mistake in &cause.mistakes {
        let one = meanings_of(&mistake.id);
        let with_one = |claim: &Vec<_>| -> Vec<Vec<&'static Mistake>> {
            one.iter().map(|m| [&claim[..], m].concat()).collect()
        };
        all = all.iter().flat_map(with_one).collect();
    }
    all
}

/// Returns the mistakes of this renderer that a name of `diagnose` may mean.
fn meanings_of(id: &str) -> Vec<Vec<&'static Mistake>> {
    let of_id = |id: &&str| MISTAKES.iter().find(|m| m.id == *id).expect("a mistake");
    let several: &[&str] = match id {
        "lights-missing" => &["diffuse-missing", "specular-missing"],
        "cull-none-depth-missing" => &["culling-missing", "depth-missing"],
        _ => &[],
    };
    let singles = MISTAKES
        .iter()
        .filter(|m| names(m.id).contains(&id))
        .map(|m| vec![m]);
    let mut all: Vec<Vec<&Mistake>> = singles.collect();
    if !several.is_empty() {
        all.push(several.iter().map(of_id).collect());
    }
    all
}

/// Counts the answers to `count` random sets of `size` mistakes, and prints a line for each.
pub fn count_sets(
    scenes: &[(&'static str, Scene)],
    count: u64,
    size: usize,
    seed: u64,
) -> BTreeMap<Worth, u64> {
    let next = AtomicU64::new(0);
    let found = Mutex::new(BTreeMap::new());
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                return;
            }
            let mut random = Random((seed * 7919 + number) * 7919 + size as u64);
            let (name, case) = loop {
                let (name, scene) = &scenes[random.below(scenes.len() as u64) as usize];
                if let Some(case) = Case::random(scene, size, &mut random) {
                    break (name, case);
                }
            };
            let answer = diagnosed(case.scene, &case.picture);
            let worth = case.worth(&answer);
            let ids: Vec<&str> = case.set.iter().map(|mistake| mistake.id).collect();
            println!("{worth:?}: {name} {}: {}", ids.join(" + "), said(&answer));
            *found.lock().unwrap().entry(worth).or_default() += 1;
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, |count| count.get()) {
            scope.spawn(work);
        }
    });
    found.into_inner().unwrap()
}

/// The share of answers that have all mistakes, at least, and of untrue ones, at most.
const NAMED: f64 = 0.8;
const UNTRUE: f64 = 0.05;

/// Returns the largest count that does not surprise among `all` random answers of which a share of
/// `share` is expected: less than one run in a hundred has more.
fn surprise(all: u64, share: f64) -> u64 {
    // The binomial distribution, from the chance of none onward.
    let mut chance = (1.0 - share).powf(all as f64);
    let mut up_to_here = chance;
    let mut count = 0;
    while up_to_here < 0.99 && count < all {
        chance *= (all - count) as f64 / (count + 1) as f64 * share / (1.0 - share);
        up_to_here += chance;
        count += 1;
    }
    count
}

#[test]
fn sets_are_explained() {
    let number = |name| {
        let text = std::env::var(name).ok()?;
        Some(text.parse().expect("a whole number"))
    };
    let seed = number("FASTPHONG_SETS_SEED").unwrap_or(1);
    let count = number("FASTPHONG_SETS");
    let (sizes, [width, height]) = match count {
        Some(_) => (2..=4, [320, 240]),
        None => (2..=3, [160, 120]),
    };
    let mut scenes = scenes(width, height);
    scenes.retain(|(name, _)| *name != "knot-100k");
    let [mut all, mut named, mut untrue] = [0; 3];
    for size in sizes {
        let found = count_sets(&scenes, count.unwrap_or(1), size, seed);
        println!("{size} mistakes: {found:?}");
        for (worth, count) in found {
            all += count;
            match worth {
                Worth::Exact | Worth::Or => named += count,
                Worth::Untrue => untrue += count,
                Worth::Part | Worth::None => {}
            }
        }
    }
    // A usual run has the same few sets each time: half of them are named, and none is untrue.
    let [least, most] = match count {
        Some(_) => [all - surprise(all, 1.0 - NAMED), surprise(all, UNTRUE)],
        None => [all.div_ceil(2), 0],
    };
    assert!(untrue <= most, "{untrue} of {all} are untrue");
    assert!(named >= least, "{named} of {all} are named");
}
