// SPDX-License-Identifier: BSD-3-Clause
// The constants of the method in one table. Those that users may change are options, such as the
// overlap ratios at which bubbles come and go (insert_below, delete_above in settings/options.cpp);
// bounds of rounding, sizes of buffers and the like stand where they are used.
// docs/reference/constants.md is written from this file (target pnpbs-reference), so each constant
// has one comment: its meaning, then [unit], then its source. Pages name a constant behind its
// number, and the test docs_constants compares the two.
#pragma once

namespace pnpbs::method {

// ---- Force ----

// The cubic law is f(w) = A w^3 - B w^2 + C, with w the distance over the desired one: A.
// [k0] Paper, equation (2).
inline constexpr double kCubicLawCube = 1.25;
// B of the cubic law. [k0] Paper, equation (2).
inline constexpr double kCubicLawSquare = 2.375;
// C of the cubic law. [k0] Paper, equation (2).
inline constexpr double kCubicLawConstant = 1.125;
// Where the cubic law ends. [d] Paper, equation (2).
inline constexpr double kCubicLawRange = 1.5;

// ---- First nodes ----

// How much d may vary within a patch that is filled with one lattice. [factor] Chosen.
inline constexpr double kPatchVariation = 1.08;
// How far new nodes of a fill stay away from the boundary. [d] docs/volumes.md, first nodes.
inline constexpr double kFillClearance = 0.5;
// How wide leaves of the background tree are at most. [d] docs/method.md, what d must be.
inline constexpr double kLeafSpacings = 4;
// Growth of d that nodes can follow. [d per d] Measured: docs/method.md, what d must be.
inline constexpr double kGrowthFollowed = 0.3;
// Growth above which d is limited unasked: samples are not exact. [kGrowthFollowed] Chosen.
inline constexpr double kTooSteep = 1.05;
// Where a node meets d below this share of its leaf's samples, the run begins anew: within a leaf,
// d that nodes can follow is twice that at least. [share] Derived from kGrowthFollowed.
inline constexpr double kFarFiner = 0.25;

// How wide triangles of a surface are at most that a fill weighs: an equilateral one has 0.8 nodes.
// [d] Chosen.
inline constexpr double kSurfacePieceEdge = 1.25;
// How many nodes a closed patch of a surface has at least. [nodes] Chosen: a tetrahedron's.
inline constexpr double kMinNodesOfClosedPatch = 4;
// How far off a side of a box the first full layer of the A15 lattice is. A flat side has 2 /
// sqrt(3) nodes per d^2, which stand for the first 0.38 d, and the lattice for all behind 0.33 d
// less than the depth of that layer. [d] Derived.
inline constexpr double kFirstA15Layer = 0.7;
// The same of the body-centred lattice, which stands for 0.27 d less. [d] Derived.
inline constexpr double kFirstBodyCentredLayer = 0.65;
// Nodes of the A15 lattice that rest at a mean distance of d. [nodes per d^3] Measured.
inline constexpr double kA15Density = 1.52;
// How large bubbles on a boundary far finer than d are. [edges of the boundary] Chosen:
// docs/method.md, what d must be.
inline constexpr double kBubbleOfEdges = 32;

// ---- Refining ----

// An edge is cut into pieces of length d, rounded up from this fraction: in the plane one longer by
// 1.4 is halved. [pieces] Chosen.
inline constexpr double kRoundUpInPlane = 0.6;
// In a volume, where what is too much is thinned: one longer by 1.25 is halved. [pieces] Chosen.
inline constexpr double kRoundUpInSpace = 0.75;
// Edges on surfaces that are longer than the d to come are halved; then they are thinned. [d to
// come] Chosen: docs/volumes.md.
inline constexpr double kHalvedOnSurfaces = 1.25;
// If a larger share of the new nodes should stay, all do: d may have been another where a node was
// before. [share] Chosen.
inline constexpr double kMostStay = 0.8;
// Nodes are thinned where d has grown by more. [factor] Chosen.
inline constexpr double kThinnedAbove = 1.02;
// And in leaves with more nodes than d asks for. [nodes that d asks for] Chosen.
inline constexpr double kCrowdedLeaf = 1.5;
// By so many, as leaves have few. [nodes] Chosen.
inline constexpr double kCrowdedLeafMore = 4;

// ---- Coarser levels ----

// Fewer nodes than this are not worth a level. [nodes] Chosen: docs/method.md, coarser levels.
inline constexpr double kMinNodesOfCoarsest = 500;
// The same of levels of surfaces alone. [nodes] Chosen.
inline constexpr double kMinNodesOfCoarsestSurface = 100;
// Growth of the coarser spacing beyond which a fill by cells is the better start. [d per d] Chosen
// below kGrowthFollowed: docs/method.md, coarser levels.
inline constexpr double kSteepestOnCoarsest = 0.27;
// How many nodes the boundary may force on a level beyond its share. [share of the level's nodes]
// Chosen: docs/method.md, coarser levels.
inline constexpr double kMaxForced = 0.2;
// When coarser levels rest, in the plane and on surfaces: steps are cheap there. [tolerance_mean]
// Chosen: docs/method.md, coarser levels.
inline constexpr double kCoarserRestInPlane = 0.3;
// The same in a volume. [tolerance_mean] Chosen: docs/method.md, coarser levels.
inline constexpr double kCoarserRestInSpace = 0.08;
// What coarser levels in space aim at, as refining leaves distances a little too large there.
// [mean_distance] Chosen: docs/method.md, coarser levels.
inline constexpr double kCoarserDistanceInSpace = 0.997;
// For how long coarser levels adjust their population. [share of their steps] As the paper's preset
// of population_share.
inline constexpr double kCoarserPopulationShare = 0.75;

// ---- Population ----

// Bubbles nearer than this touch: nearly all that are joined by a Delaunay edge. The next shell of
// the lattice is at 1.73 in the plane, at 1.53 in a volume. [d] Chosen between these shells.
inline constexpr double kTouch = 1.3;
// A bubble beside the boundary with a larger overlap ratio is squeezed by nodes that cannot move,
// and tells nothing of the density. [ideal ratio] Chosen.
inline constexpr double kSqueezed = 7.0 / 6;
// By how much the mean distance may be off on coarser levels before bubbles act. [d] Chosen:
// docs/method.md, how many nodes.
inline constexpr double kDistanceTolerance = 0.001;
// The same on the finest level, where each change costs steps. [kDistanceTolerance] Chosen:
// docs/method.md, how many nodes.
inline constexpr int kDistanceToleranceOnFinest = 3;
// The same in a volume for nodes that were taken over, in the first two rounds of an event. [d]
// Chosen.
inline constexpr double kDistanceOff = 0.01;
// The same in later rounds, and where a lattice fills the finest level. [d] Chosen.
inline constexpr double kDistanceFarOff = 0.02;
// New bubbles for too small a ratio come no nearer to others. A place in the middle of lattice
// nodes has 0.577 between three, 0.605 between four. [d] Chosen above these.
inline constexpr double kMinGap = 0.75;
// The same of bubbles that bring the mean distance down. [d] Chosen below these.
inline constexpr double kMinGapToAim = 0.55;
// How far a contest reaches. Nodes across a hole are two spacings apart, which two steps may not
// bridge. [neighbours] Derived: docs/architecture.md, contests.
inline constexpr int kContestHops = 3;
// In a volume rivals are also no farther apart: else one of 600 would act at a time. [d] Chosen:
// docs/architecture.md, contests.
inline constexpr double kContestReachInSpace = 1.5;
// A bubble this near to another one goes. [d] docs/method.md, near the boundary.
inline constexpr double kNearlyCoincide = 0.2;
// Rounds of an event at most, while each changes much. [rounds] Chosen.
inline constexpr int kMaxPopulationRounds = 20;
// What counts as much. [share of the nodes] Chosen.
inline constexpr double kMuchChange = 0.002;
// Quiet events in a row that end the adjustment. [events] docs/method.md, when a run ends.
inline constexpr int kQuietEvents = 2;
// The same after coarser levels. [events] docs/method.md, when a run ends.
inline constexpr int kQuietEventsRefined = 1;
// What a quiet event may change after coarser levels. [population_tolerance] docs/method.md, when a
// run ends.
inline constexpr double kRefinedTolerance = 5;
// With fewer of the expected nodes the adjustment goes on beyond population_share. [share] Chosen.
inline constexpr double kFarTooFew = 0.85;

// ---- Near the boundary ----

// How far nodes keep off the boundary in the plane, and those on surfaces off feature edges. [d]
// docs/method.md, near the boundary.
inline constexpr double kBoundaryClearance = 0.4;
// The same in a volume, where a layer of tetrahedra is 0.82 d thick. [d] Measured: with 0.65 and
// 0.5 the worst tetrahedra are worse.
inline constexpr double kVolumeClearance = 0.75;
// The same of new nodes in a volume. [d] docs/volumes.md.
inline constexpr double kNewNodeClearance = 0.5;
// With less there is no room: a wedge or gap narrower than 0.7 d. [d] docs/method.md, near the
// boundary.
inline constexpr double kMinClearance = 0.35;

// ---- Finish in the plane ----

// Shorter edges of the boundary have no node of the first row. [d] Chosen: docs/method.md, near the
// boundary.
inline constexpr double kRegularEdgeMin = 0.75;
// Longer edges of the boundary have none either. [d] Chosen.
inline constexpr double kRegularEdgeMax = 1.3;
// Nor have edges at whose ends the boundary turns by more than 30 degrees. [cosine] Chosen.
inline constexpr double kRegularTurnCosine = 0.87;
// How far the boundary is from a place over its edge, if a row of nodes fits there: on the way to
// the first row, in it, and in the second. [height of the place] Chosen.
inline constexpr double kApexRoom = 0.75;
// Nodes of the first row that were nearer to each other do not come. [edge] Chosen.
inline constexpr double kApexesApart = 0.7;
// There is no first row where d falls faster, inwards or along the boundary. [d per d] Measured:
// with 0.1 it pays, with 0.2 no more.
inline constexpr double kFirstRowMaxFall = 0.15;
// Of the nodes this near to a place of the first row one goes there, and no other stays. [edge]
// Measured with kFirstRowDepth.
inline constexpr double kApexTakes = 0.5;
// Nodes that are nearer to edges with a node of the first row are of it, or go. The first row is at
// 0.87, the second at 1.73. [edge] Measured: with 1.4 fewer nodes stay than there is room for.
inline constexpr double kFirstRowDepth = 1.2;
// How far a sweep moves a node at most. [d] Chosen.
inline constexpr double kSweepMaxMove = 0.1;
// Triangles below this are not to get worse by a sweep. [quality] Chosen.
inline constexpr double kSweepGuardsBelow = 0.75;
// Sweeps during which stars stay as they are. [sweeps] Chosen.
inline constexpr int kSweepsOnStars = 5;
// Triangles below this are not to get worse by a sweep to centroids, which flips edges as it needs.
// [quality] Chosen below all that a Delaunay triangulation of such nodes has.
inline constexpr double kCentroidalSweepGuardsBelow = 0.3;
// Triangles with a larger angle are repaired by obtuse_rounds. [degrees] Chosen below 90.
inline constexpr double kObtuseRepairAngle = 89.5;
// A smallest angle that is as bad for that repair as a right one. [degrees] Chosen: the smallest
// angles are 36 to 41 degrees where d grows by less than 0.1.
inline constexpr double kObtuseRepairMinAngle = 35;
// Nodes with so few neighbours may be surplus. [neighbours] docs/method.md.
inline constexpr int kFewNeighbours = 4;
// A surplus node goes if the least quality around it rises by this. [quality] docs/method.md.
inline constexpr double kSurplusPays = 0.02;
// Triangles below this are repaired first. [shape] docs/method.md.
inline constexpr double kWorstBelow = 0.82;
// Weight of the sine of the smallest angle in a triangle's shape: 38.5 degrees count as much as a
// quality of 0.85. [factor] Derived: 0.85 / sin(38.5 degrees).
inline constexpr double kAngleWeight = 1.365;
// The first and longest way on which a better place for a node of a bad triangle is sought; each
// further one is half as long. [d] Chosen.
inline constexpr double kRepairFirstWay = 0.08;
// The last and shortest. [d] Chosen.
inline constexpr double kRepairLastWay = 0.01;
// Triangles below this are defects of the topology. [quality] docs/method.md.
inline constexpr double kDefectBelow = 0.84;
// What a repair must gain: the decrease of the sum of (1 - quality)^2. [quality squared]
// docs/method.md.
inline constexpr double kDefectPays = 0.01;
// A new node comes no nearer to the nodes there. [d] Chosen.
inline constexpr double kDefectMinGap = 0.4;
// Defects no farther apart are one cluster, of which the worst is tried. [rings] Chosen.
inline constexpr int kClusterRings = 2;
// How far from a defect the node may be that goes for it. [rings] Chosen.
inline constexpr int kSurplusRings = 2;
// How far apart defects are that are repaired at once. [rings] docs/method.md.
inline constexpr int kDefectContestRings = 5;
// What is copied around a defect; those of the last ring stay. [rings] docs/method.md.
inline constexpr int kPatchRings = 4;
// Steps in which the copy is relaxed. [steps] Chosen.
inline constexpr int kPatchSteps = 20;
// After so many of them edges are flipped. [steps] Chosen.
inline constexpr int kPatchStepsBetweenFlips = 5;
// How far each of them moves a node. [share of the way to the mean of its neighbours] Chosen.
inline constexpr double kPatchWay = 0.8;

// ---- Finish in space ----

// How far sweeps and repairs keep nodes off the surface: no triangle of it is missing then. [d]
// Measured.
inline constexpr double kFinishClearance = 0.6;
// The same at inner surfaces, with nodes on both sides: triangles in their corners have
// circumcircles of 0.71 d. [d] Derived.
inline constexpr double kInnerClearance = 0.75;
// Rounds of sweeps and repairs between which the boundary is refined. [rounds] Chosen.
inline constexpr int kMaxFinishRounds = 3;
// Sweeps between the two repairs of slivers. [sweeps] Chosen.
inline constexpr int kSweepsBetweenRepairs = 2;
// Tetrahedra with a smaller dihedral angle are repaired before all others. [degrees] Chosen.
inline constexpr double kFlatBelow = 10;
// The same after these. [degrees] Chosen.
inline constexpr double kThinBelow = 20;
// Angles up to this much above sliver_angle must not become worse. [degrees] docs/volumes.md: 38
// degrees by default.
inline constexpr double kPenaltyAbove = 5;
// Rounds of a repair at most. [rounds] Chosen.
inline constexpr int kSliverRounds = 100;
// A repair ends where more attempts have been in vain. [share of the nodes] Chosen.
inline constexpr double kMaxInVain = 0.1;
// An attempt to move a node along a surface counts as so many of these, as all stars around are
// made anew for each place. [attempts] Chosen.
inline constexpr int kWorkOfSurfaceMove = 3;
// Places that are tried for a node whose turn it is. [trials] Chosen.
inline constexpr int kSliverTrials = 8;
// How far these are at least. [d] docs/volumes.md.
inline constexpr double kSliverShortestWay = 0.08;
// And at most. [d] docs/volumes.md.
inline constexpr double kSliverLongestWay = 0.28;
// Turns of a sliver's corners for each turn of a neighbour. [turns] Chosen.
inline constexpr int kSliverTurnsOfCorners = 5;
// What a move changes lies within this distance of the node. [d] Chosen.
inline constexpr double kSliverReach = 1.8;
// How far a repair moves a node in all. [d] Chosen.
inline constexpr double kSliverDrift = 0.6;
// Half of the longest edge where nodes have come to rest. [d] Measured.
inline constexpr double kSliverEdge = 0.9;
// How many neighbours away a move looks at stars, and one more since nodes come to be neighbours.
// [rings] Derived.
inline constexpr int kSliverRings = 4;
// Nodes on one sheet of the surface come no nearer to each other in a repair. [d] Chosen.
inline constexpr double kSliverRoom = 0.7;
// A repair that moves a node along the surface takes all nodes of the boundary up to this distance
// into account. [d] Derived: no more than are known to the node's rank.
inline constexpr double kSliverSight = 2.5;
// Elements with a smaller dihedral angle that the repairs leave may have a node removed or
// inserted. [degrees] Chosen.
inline constexpr double kThinElement = 15;
// An element with a shorter edge than this between two nodes of the boundary has one of these
// removed. [d] Derived: with the other edges d, the angle opposite to it is 29 degrees at most.
inline constexpr double kShortEdge = 0.5;
// Two curves that leave the ends of a short edge run beside each other if the angle between their
// next edges has a larger cosine: 20 degrees. [1] Chosen.
inline constexpr double kBesideCosine = 0.94;
// And if both edges are longer than this. [d] Chosen.
inline constexpr double kBesideLength = 0.5;
// An edge shorter than this loses a node even there: so little makes no curve ragged. [d] Chosen.
inline constexpr double kRagged = 0.05;
// Elements with a smaller dihedral angle whose label is open to choice are made none where the
// boundary stays closed. [degrees] Chosen.
inline constexpr double kThinLabel = 10;
// A node that is inserted in a flat element has at least this distance to the nodes of the element.
// [d] Chosen.
inline constexpr double kRoomInSliver = 0.4;
// The same where three of these are on features, and do not move. [d] Chosen.
inline constexpr double kRoomInHeldSliver = 0.2;
// And so much of that to the surface. [share] Chosen.
inline constexpr double kSliverClearance = 0.6;
// Nodes that are inserted in flat elements at the same time are no nearer to each other. [d]
// Chosen.
inline constexpr double kSliversApart = 1;
// Rounds in which nodes are removed and inserted before the next repair, at most. [rounds] Chosen.
inline constexpr int kThinRounds = 3;
// Repairs of the elements that are still thin, at most. [repairs] Chosen.
inline constexpr int kThinRepairs = 2;
// These are omitted where more elements are thin: walls and steps much smaller than d, where no
// repair helps. [share of the nodes] Chosen.
inline constexpr double kManyThin = 0.02;

// ---- The surface in space ----

// Places on a surface that are farther from all nodes are vacant: in a lattice none is farther than
// 0.58, where bubbles rest hardly any farther than 0.75. [d] docs/volumes.md.
inline constexpr double kVacant = 0.80;
// How far the middle of a vacancy's circle may be off the surface. [d] Chosen.
inline constexpr double kVacancyBend = 0.3;
// Places farther from all nodes that were taken over are filled before bubbles move: in a lattice
// none is farther than 0.58 on a surface, 0.61 inside. [d] Chosen.
inline constexpr double kGap = 0.8;
// Walls thinner than that have the nodes of their two sides opposite each other. [d] Measured: in a
// plate of 0.2 d, tetrahedra between other nodes fill the body, in one of 0.1 d they do not.
inline constexpr double kThinWall = 0.25;
// The same of gaps, whose tetrahedra are no elements and may have any angles. [d] Chosen.
inline constexpr double kNarrowGap = 0.5;
// How far such a node is from the place straight through a wall of thickness t. [t^2/d] Measured: a
// stack of plates of 0.05 d and of gaps of 0.03 d conforms with 0.6, and not with 6.
inline constexpr double kAsideInThinWall = 0.6;
// How far it keeps off feature edges. [d] Chosen.
inline constexpr double kPartnerClearance = 0.3;
// How far it keeps off other nodes. [d] Chosen.
inline constexpr double kPartnerGap = 0.5;
// A node this near to the middle of a ball that is to get one stands for it. [radius of the ball]
// Chosen.
inline constexpr double kBallTaken = 0.3;
// Middles of such balls are no nearer to each other. [radius of the larger ball] Chosen.
inline constexpr double kBallsApart = 0.7;
// Rounds in which such nodes come, at most. [rounds] Chosen.
inline constexpr int kMaxBallRounds = 12;
// So many of them happen though faces that stray do not become fewer. [rounds] Chosen.
inline constexpr int kBallRoundsAnyway = 2;
// So few faces that stray come by chance, and need not become fewer. [faces] Chosen.
inline constexpr int kFewStrays = 10;
// Rounds in which nodes come to the boundary and leave its way, at most. [rounds] Chosen.
inline constexpr int kMaxBoundaryRounds = 8;

// ---- Holding d down in space ----

// To what d is held where a round does not conform. [d] docs/volumes.md.
inline constexpr double kHeldTo = 0.5;
// Rounds that do only this. In later ones d goes by what is narrow there, too. [rounds] Measured:
// of 32 bodies of about five parts that need rounds, at 400 nodes, 9 are torn in the end without
// these later ones, and 1 with them.
inline constexpr int kRoundsOfHalves = 1;
// How many steps such a round may take: d jumps in slope where it is held. [steps of the option]
// Measured: elephant.off of CGAL, at 3 000 nodes and min_angle 20, rests after 50 to 80 steps.
inline constexpr int kStepsWhereHeld = 2;
// Dihedral angles that a user is told of who does not want d reduced for them. [degrees] As the
// option min_angle.
inline constexpr double kSmallAngle = 2;
// What share of the small angles a round may leave to count. [share] Chosen.
inline constexpr double kSmallAnglesLeft = 0.5;
// Rounds that do not count, at most. [rounds] Chosen: each takes as long as a run.
inline constexpr int kMaxRoundsInVain = 2;
// The same in a row, of rounds after one whose elements do not conform. [rounds] Chosen.
inline constexpr int kMaxRoundsInVainToConform = 3;
// With more nodes than in the first round d is a mistake. [nodes of that round] Chosen.
inline constexpr double kMaxGrowthOfNodes = 4;
// The same where the last round does not conform. [nodes of the first round] Chosen.
inline constexpr double kMaxGrowthToConform = 10;
// Unless they are so few in all. [nodes] Chosen.
inline constexpr double kFewNodesToConform = 5000;
// Layers of nodes that the option resolve wants in a wall: those of its sides count half. [layers]
// Derived: one in the middle.
inline constexpr double kLayersInWall = 2;
// The same in a gap: each side keeps its nodes out of the spheres around triangles of the other,
// which reach 0.58 d if these are equilateral, and d between two points is larger. [layers]
// Derived.
inline constexpr double kLayersInGap = 4.0 / 3;
// An edge with a smaller angle between its sides is sharp: slivers are repaired up to that angle.
// [degrees] As the option sliver_angle.
inline constexpr double kSharpEdge = 33;
// Nodes of pieces too many that are nearer than this to each other leave. [d] Chosen.
inline constexpr double kSmallPiece = 0.5;
// Rounds before tips leave: one more halving of d leaves the same picture there, only smaller.
// [rounds] Chosen.
inline constexpr int kRoundsBeforeTips = 2;
// Nodes on the boundary are beside each other up to this distance. [d] Chosen as kTouch.
inline constexpr double kBeside = 1.3;
// Tries with a tree that knows finer places. Each shows its surroundings: two do, mostly. [tries]
// Chosen.
inline constexpr int kMaxTreeTries = 4;

}  // namespace pnpbs::method
