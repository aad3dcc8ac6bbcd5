//! The pictures of a report: the mechanism at rest, and as many animated forced vibrations and modes as a file of moderate
//! size holds.

use eigentol::kernels::PictureKernels;
use eigentol::picture::{ModePictures, Scene, VibrationPictures};
use eigentol::{Error, Excitation, Study};

use crate::forced::harmonics;

/// Maximum number of poses over all modes and vibrations; they make up most of a file.
pub(crate) const POSES: usize = 14_000;
/// The same where a page is to be there at once.
pub(crate) const FEW_POSES: usize = 2_000;
/// Number of poses per period. The view interpolates linearly between them.
const MOST_FRAMES: usize = 24;
const LEAST_FRAMES: usize = 8;

/// Largest displacement in a mode or a vibration, as a fraction of the size of the mechanism.
pub(crate) const AMPLITUDE: f64 = 0.12;

/// The number of animated motions, and the number of frames in each, of so many poses in all and so many per frame.
fn frames(all: usize, poses: usize, motions: usize) -> (usize, usize) {
    let most = all / poses.max(1);
    let frames = (most / motions.max(1)).clamp(LEAST_FRAMES, MOST_FRAMES);
    (motions.min(most / frames), frames)
}

/// Data for the pictures.
pub(crate) struct Pictures {
    pub(crate) scene: Scene,
    /// The first modes only, for large mechanisms.
    pub(crate) modes: Vec<Result<ModePictures, Error>>,
    /// Of each harmonic, unless the mechanism is large.
    pub(crate) vibrations: Vec<Result<VibrationPictures, Error>>,
}

impl Pictures {
    pub(crate) fn of<M: PictureKernels>(study: &Study<M>, poses: usize) -> Result<Self, Error> {
        let scene = study.picture()?;
        let harmonics = harmonics(study.description());
        let motions = harmonics.len() + study.modes()?.modes.len();
        let (shown, phases) = frames(poses, scene.poses(), motions);
        let vibrations = harmonics
            .into_iter()
            .take(shown)
            .map(|excitation| study.vibration_pictures(Excitation::new(excitation), phases, AMPLITUDE));
        let vibrations: Vec<_> = vibrations.collect();
        let modes = 0..shown - vibrations.len();
        let modes = modes.map(|mode| study.mode_pictures(mode, phases, AMPLITUDE));
        Ok(Self { modes: modes.collect(), vibrations, scene })
    }

    pub(crate) fn at_rest(scene: Scene) -> Self {
        Self { scene, modes: Vec::new(), vibrations: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::{LEAST_FRAMES, MOST_FRAMES, POSES, frames};

    #[test]
    fn large_mechanisms_get_fewer_poses_and_then_fewer_modes() {
        assert_eq!(frames(POSES, 3, 2), (2, MOST_FRAMES));
        assert_eq!(frames(POSES, 0, 0), (0, MOST_FRAMES));
        for (bodies, modes) in [(30, 30), (60, 120), (POSES, 5), (2 * POSES, 5)] {
            let (animated, each) = frames(POSES, bodies, modes);
            assert!(animated <= modes && (LEAST_FRAMES..=MOST_FRAMES).contains(&each));
            assert!(bodies * animated * each <= POSES, "{bodies} {modes}");
        }
    }
}
