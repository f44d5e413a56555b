//! Seeds of rooms that failed once, and for how many half seconds they are run: beyond where they did.

/// Those that take less than a second each as far as that.
#[rustfmt::skip]
pub(crate) const MENDED: [(u64, u32); 83] = [
    (65, 20), (124, 20), (132, 20), (137, 20), (141, 20), (147, 20), (152, 20), (164, 20), (168, 20), (175, 20),
    (177, 20), (179, 20), (201, 20), (226, 20), (251, 20), (267, 20), (281, 20), (295, 20), (306, 20), (322, 20),
    (325, 20), (360, 20), (371, 20), (396, 20), (421, 20), (424, 20), (447, 20), (461, 20), (473, 20), (590, 20),
    (656, 13), (679, 20), (782, 8), (896, 10), (996, 9), (1247, 20), (2093, 14), (2098, 9), (2203, 19), (2464, 6), (2480, 5),
    (2658, 11), (2751, 6), (2798, 9), (3361, 11), (4246, 15), (4267, 12), (4348, 13), (4960, 7), (5266, 9), (5459, 4),
    (5921, 6), (6176, 20), (7688, 18), (7726, 16), (8361, 8), (8635, 7), (8877, 12), (8925, 9), (9224, 10), (9314, 17), (9949, 4),
    (10167, 18), (10337, 13), (10941, 8), (11044, 11), (11163, 16), (11592, 12), (11817, 9), (12395, 9), (12923, 4), (13532, 9),
    (13632, 14), (13928, 9), (13947, 7), (14061, 5), (14129, 6), (14253, 12), (14636, 7), (14849, 17), (14909, 8), (14981, 10),
    (15190, 13),
];

/// Those that chatter without a rest speed, or roll over each other most of the time, and take seconds each. Only the
/// campaign runs them too.
#[rustfmt::skip]
pub(crate) const LABORIOUS: [(u64, u32); 73] = [
    (50, 20), (74, 20), (103, 20), (153, 20), (167, 20), (184, 20), (271, 20), (491, 20), (661, 7), (743, 6),
    (790, 7), (1025, 13), (1198, 12), (1218, 20), (1342, 6), (1383, 7), (1482, 7), (1490, 12), (1904, 11), (1986, 11),
    (2054, 19), (2234, 8), (2335, 13), (2481, 16), (2959, 8), (3184, 16), (3518, 17), (3624, 11), (4104, 10), (4207, 15),
    (5311, 9), (5430, 6), (5928, 13), (6402, 12), (6414, 20), (6919, 18), (6920, 11), (7533, 12), (7793, 7), (8016, 17),
    (8025, 7), (8129, 18), (8474, 8), (9273, 11), (9329, 15), (9368, 15), (9715, 9), (9752, 16), (9970, 7), (10108, 14),
    (10445, 10), (10595, 20), (10635, 15), (10676, 12), (10864, 11), (11024, 12), (11118, 13), (11666, 17), (11721, 13), (11756, 14),
    (12512, 14), (12666, 11), (12869, 9), (13207, 11), (13365, 13), (13397, 13), (13406, 14), (13587, 13), (13917, 6), (13986, 12),
    (14142, 14), (14757, 12), (17608, 20),
];

/// Stacks that stood still at an instant, or took a thousand settlements for one contact that let go; where to clear the
/// velocities closed what had opened, and nothing asked whether it carries; or that hopped on an elastic wall that rubs, each
/// of millions of hops alone; and two that crept by some ulp of the clock, two contacts of 1e-15 m/s let go and met in turn:
/// releases were counted at one instant only. In 14597 the corner was taken for the closest point, 4e-9 m beside it.
pub(crate) const MENDED_STACKS: [(u64, u32); 9] =
    [(16, 3), (118, 2), (148, 2), (3897, 1), (4473, 1), (5869, 1), (7211, 1), (11186, 1), (14597, 13)];

/// Heaps in which spheres just fit between walls: next to their line, rounding of their gaps moved them by a million times as
/// much, rounding of their velocities stopped others that slid by, loads of 1e9 N worked, and arcs went on where their
/// equation was none any more; one in which the judge took what closes its own small gap for no rest; one whose arcs were
/// over as they began, for loads of 1e-15 N; one in which the judge did not know what a place that is rounded is worth under
/// 1e11 N; and four in which a sphere came into a wall while it rested beside it, or what rests moved: in 10994, to close what
/// opens by rounding drove it there.
#[rustfmt::skip]
pub(crate) const MENDED_HEAPS: [(u64, u32); 12] = [
    (135, 2), (1393, 2), (1395, 2), (2231, 2), (2507, 2), (3579, 2), (4145, 2), (4567, 2), (9510, 2), (10994, 2), (12672, 2),
    (13373, 2),
];

/// Funnels: what let go at an instant went on as if still held, and summed-up bounces struck meanwhile with their mean velocity;
/// a sphere went straight from wall to wall four million times a second, impact by impact; an approach that would have
/// stopped by itself was found again for ever; what was held for a moment, or just opened, was driven into its wall; two
/// that overlapped while a low hop was measured by what pulls a sphere instead of by what its contact carries; and three that
/// pass since an island is solved again that let something go uncleared: in 4738, where a contact opened by 1e-38 m/s, what
/// held kept the speed of a hop that it did not begin.
#[rustfmt::skip]
pub(crate) const MENDED_FUNNELS: [(u64, u32); 14] = [
    (6, 12), (151, 5), (377, 2), (459, 11), (1825, 5), (2558, 11), (3221, 20), (4738, 7), (8817, 20), (13270, 5), (13358, 12),
    (13882, 13), (17919, 20), (18213, 3),
];

/// Tubes: what just fits drifted into a wall, was stopped by the rounding of the edges at the tube's end, grazed its two
/// walls in turn at one instant, was struck before its walls held it, or went to and fro by less than coordinates tell.
#[rustfmt::skip]
pub(crate) const MENDED_TUBES: [(u64, u32); 17] = [
    (222, 5), (257, 1), (2886, 20), (6584, 20), (2951, 20), (3226, 17), (3761, 20), (4370, 20), (5548, 12), (6641, 8), (6743, 18), (6753, 14), (6920, 13),
    (7479, 3), (7451, 15), (7573, 6), (7661, 8),
];

/// Joints where the judge took the edge beside the foot for the closest point; where a seam ahead was found to be met sooner
/// than the clock can tell, and was left, again and again; and where the judge took the impact after a million hops for one
/// with them. In 2916 an impact on the next tile lifts the sphere by less than it is held down, and comes again unless it
/// rests.
pub(crate) const MENDED_JOINTS: [(u64, u32); 6] = [(1778, 2), (2916, 9), (3125, 3), (3416, 3), (8874, 4), (19727, 20)];

/// Beside seams: a sphere on a floor that met a step of 1e-13 to 1e-9 r went on into it, or stood before it for ever, for
/// what lifts it off the floor was taken back as too low a hop; one that slid along such a step and neared it slowly was
/// let pass, by its whole speed; and the judge, near the end of an edge, took the corner for the closest point. In 7901 the
/// edge beside a seam stayed held once its sphere had been struck off both tiles; in 2354 the part ahead was read from a
/// speed of 1e-89 m/s; in 4720 an edge 1e-12 r away was met by rounding, in 6687 the sphere was cleared into it; in 13821
/// what rests was struck by rounding for ever.
#[rustfmt::skip]
pub(crate) const MENDED_SEAMS: [(u64, u32); 17] = [
    (594, 9), (1660, 9), (1721, 2), (2354, 2), (2727, 8), (3309, 6), (3812, 20), (3995, 20), (4291, 2), (4445, 6), (4720, 20),
    (5054, 9), (5136, 20), (5312, 2), (6687, 3), (7901, 1), (13821, 1),
];

/// Crowds in which small spheres met from afar, too late by the cancellation of their squared distance; passed through each
/// other, where a plan that was made for another trajectory had been put off; or were struck in a wedge a million times,
/// and sank in meanwhile, or went on for ever, some of them because a wall at which they came to rest was never asked, or
/// because those that pass each other at 200 km/s were parted where they would have parted sooner than the clock can tell.
/// In 5469 releases of one island are counted while another one hardly moves.
#[rustfmt::skip]
pub(crate) const MENDED_CROWDS: [(u64, u32); 22] = [
    (153, 3), (205, 3), (262, 3), (731, 4), (1289, 4), (2539, 4), (3700, 4), (4421, 4), (5115, 4), (5469, 4), (6079, 4), (7425, 4),
    (7504, 4), (8010, 4), (8377, 4), (9336, 4), (10128, 4), (10740, 4), (13465, 4), (16193, 4), (17626, 4), (18744, 4),
];

/// Of the generator of other units: where the foot passed from a face over an edge, rounding made an impact that took half the
/// speed; the second is one of the check, of an event at the level from which on events are told. Bounces were summed up that
/// were too high for that; the end of a sum was waited for in curved islands; an edge of the next tile rubbed by an approach
/// of rounding; the last are of the check: independent events change places.
pub(crate) const MENDED_UNITS: [(u64, u32); 7] =
    [(2028, 20), (4178, 20), (12331, 20), (17084, 20), (17089, 20), (18638, 20), (19811, 20)];

/// What gained energy by `swept`, which lifted bodies at rest out of overlaps that its tolerance allows.
pub(crate) const SWEPT_JOINTS: [u64; 1] = [154];
pub(crate) const SWEPT_FUNNELS: [u64; 3] = [165, 201, 272];
pub(crate) const SWEPT_STACKS: [u64; 2] = [142, 144];
