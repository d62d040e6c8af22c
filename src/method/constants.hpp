// SPDX-License-Identifier: BSD-3-Clause
// The constants of the method in one table. Constants that users may change are options instead,
// such as the overlap ratios at which bubbles are inserted and deleted (insert_below, delete_above
// in settings/options.cpp). Rounding bounds, buffer sizes and the like are defined where they are
// used.
//
// The target pnpbs-reference generates docs/reference/constants.md from this file. Each constant
// therefore has one comment: its meaning, then [unit], then its source. The source "Chosen" means
// that no measurement is documented. Documentation pages name a constant behind its number, and the
// test docs_constants compares the two.
#pragma once

namespace pnpbs::method {

// ---- Force ----

// Coefficient A of the cubic pair law f(w) = A w^3 - B w^2 + C, where w is the distance over the
// desired distance. [k0] Paper, equation (2).
inline constexpr double kCubicLawCube = 1.25;
// Coefficient B of the cubic law. [k0] Paper, equation (2).
inline constexpr double kCubicLawSquare = 2.375;
// Coefficient C of the cubic law. [k0] Paper, equation (2).
inline constexpr double kCubicLawConstant = 1.125;
// Range of the cubic law, beyond which the force is 0. [d] Paper, equation (2).
inline constexpr double kCubicLawRange = 1.5;

// ---- First nodes ----

// Ratio of the largest to the smallest d up to which d counts as constant, so that one lattice
// fills the patch. [factor] Chosen.
inline constexpr double kPatchVariation = 1.08;
// Distance that the nodes of a fill keep from the boundary. [d] docs/volumes.md, first nodes.
inline constexpr double kFillClearance = 0.5;
// Maximum width of the leaves of the background tree. [d] docs/method.md, what d must be.
inline constexpr double kLeafSpacings = 4;
// Largest growth of d that nodes can follow. [d per d] Measured: docs/method.md, what d must be.
inline constexpr double kGrowthFollowed = 0.3;
// Growth above which d is limited even if growth_limit is not set. It is above 1 because samples
// are not exact. [kGrowthFollowed] Chosen.
inline constexpr double kTooSteep = 1.05;
// A run starts again with a refined tree if d at a node is below this share of the samples of its
// leaf. A spacing that nodes can follow falls to no less than twice this share within a leaf.
// [share] Derived from kGrowthFollowed.
inline constexpr double kFarFiner = 0.25;

// Maximum edge of the triangles into which a fill divides a surface. An equilateral triangle of
// this size counts as 0.8 nodes. [d] Chosen.
inline constexpr double kSurfacePieceEdge = 1.25;
// Minimum number of nodes on a closed patch of a surface. [nodes] Chosen: a tetrahedron.
inline constexpr double kMinNodesOfClosedPatch = 4;
// Distance of the first full layer of the A15 lattice from a flat side of a box. The nodes of the
// side, 2 / sqrt(3) per d^2, account for the first 0.38 d, and the lattice accounts for all beyond
// the depth of that layer less 0.33 d. [d] Derived.
inline constexpr double kFirstA15Layer = 0.7;
// Distance of the first full layer of the body-centred cubic lattice, which accounts for all beyond
// that depth less 0.27 d. [d] Derived.
inline constexpr double kFirstBodyCentredLayer = 0.65;
// Density of the A15 lattice whose bubbles rest at a mean distance of d. [nodes per d^3] Measured.
inline constexpr double kA15Density = 1.52;
// Upper bound of d on a boundary whose own edges are far shorter than d. [edges of the boundary]
// Chosen: docs/method.md, what d must be.
inline constexpr double kBubbleOfEdges = 32;

// ---- Refining ----

// Summand in the number of pieces of an edge in the plane, which is length / d plus this, rounded
// down. An edge is halved from 1.4 d on. [pieces] Chosen.
inline constexpr double kRoundUpInPlane = 0.6;
// The same summand in space, where surplus nodes are thinned afterwards. An edge is halved from
// 1.25 d on. [pieces] Chosen.
inline constexpr double kRoundUpInSpace = 0.75;
// Length above which edges on surfaces are halved when a level is refined. The nodes are thinned
// afterwards. [d of the next level] Chosen: docs/volumes.md.
inline constexpr double kHalvedOnSurfaces = 1.25;
// Share of the new nodes above which thinning keeps all of them. Such a share means that d was
// different when the nodes were placed. [share] Chosen.
inline constexpr double kMostStay = 0.8;
// Increase of d at a node above which nodes are thinned. [factor] Chosen.
inline constexpr double kThinnedAbove = 1.02;
// Number of nodes in a leaf above which its nodes are thinned, together with kCrowdedLeafMore.
// [nodes expected for d] Chosen.
inline constexpr double kCrowdedLeaf = 1.5;
// Number of nodes that is added to this bound, because leaves have few nodes. [nodes] Chosen.
inline constexpr double kCrowdedLeafMore = 4;

// ---- Coarser levels ----

// Minimum number of nodes of the coarsest level. [nodes] Chosen: docs/method.md, coarser levels.
inline constexpr double kMinNodesOfCoarsest = 500;
// Minimum number of nodes of the coarsest level of surfaces alone. [nodes] Chosen.
inline constexpr double kMinNodesOfCoarsestSurface = 100;
// Maximum growth of d on the coarsest level. Beyond it, a fill by cells is a better start. [d per
// d] Chosen below kGrowthFollowed: docs/method.md, coarser levels.
inline constexpr double kSteepestOnCoarsest = 0.27;
// Maximum number of boundary nodes of a level that exceed the boundary's share. [share of the
// level's nodes] Chosen: docs/method.md, coarser levels.
inline constexpr double kMaxForced = 0.2;
// Mean speed at which coarser levels in the plane and on surfaces rest. Steps are cheap on these
// levels. [tolerance_mean] Chosen: docs/method.md, coarser levels.
inline constexpr double kCoarserRestInPlane = 0.3;
// Mean speed at which coarser levels in a volume rest. [tolerance_mean] Chosen: docs/method.md,
// coarser levels.
inline constexpr double kCoarserRestInSpace = 0.08;
// Target mean distance on coarser levels in space. It is below 1 because refining leaves slightly
// too large distances there. [mean_distance] Chosen: docs/method.md, coarser levels.
inline constexpr double kCoarserDistanceInSpace = 0.997;
// Share of the steps in which coarser levels adjust their population. [share of their steps] Value
// of population_share under method=paper.
inline constexpr double kCoarserPopulationShare = 0.75;

// ---- Population ----

// Distance below which bubbles touch. Nearly all pairs with a Delaunay edge are closer. The next
// shell of the lattice is at 1.73 in the plane and at 1.53 in a volume. [d] Chosen between these
// shells.
inline constexpr double kTouch = 1.3;
// Overlap ratio above which a bubble beside the boundary is squeezed by nodes that cannot move.
// Such a bubble does not count for the density. [ideal ratio] Chosen.
inline constexpr double kSqueezed = 7.0 / 6;
// Tolerated deviation of the mean distance on coarser levels. [d] Chosen: docs/method.md, how many
// nodes.
inline constexpr double kDistanceTolerance = 0.001;
// Tolerated deviation of the mean distance on the finest level, where each change of the population
// costs steps. [kDistanceTolerance] Chosen: docs/method.md, how many nodes.
inline constexpr int kDistanceToleranceOnFinest = 3;
// Tolerated deviation of the mean distance in a volume whose nodes were taken over from an earlier
// placement, in the first two rounds of an event. [d] Chosen.
inline constexpr double kDistanceOff = 0.01;
// The same deviation in later rounds, and on a finest level that was filled by a lattice. [d]
// Chosen.
inline constexpr double kDistanceFarOff = 0.02;
// Minimum distance from other nodes of a bubble that is inserted because of a small overlap ratio.
// The centre of a lattice triangle has a distance of 0.577, that of a tetrahedron 0.605. [d] Chosen
// above these.
inline constexpr double kMinGap = 0.75;
// Minimum distance from other nodes of a bubble that is inserted to reduce the mean distance. [d]
// Chosen below these.
inline constexpr double kMinGapToAim = 0.55;
// Distance within which candidates for insertion and deletion are rivals. Nodes on opposite sides
// of a hole are two spacings apart, which two hops may not bridge. [hops of the lists] Derived:
// docs/architecture.md, contests.
inline constexpr int kContestHops = 3;
// Distance in a volume beyond which candidates are no rivals. Without it only one of 600 nodes acts
// at a time. [d] Chosen: docs/architecture.md, contests.
inline constexpr double kContestReachInSpace = 1.5;
// Distance below which one of two nodes is deleted. [d] docs/method.md, near the boundary.
inline constexpr double kNearlyCoincide = 0.2;
// Maximum number of rounds of an event. [rounds] Chosen.
inline constexpr int kMaxPopulationRounds = 20;
// Share of changed nodes above which another round follows. [share of the nodes] Chosen.
inline constexpr double kMuchChange = 0.002;
// Number of consecutive quiet events that end the adjustment of the population. [events]
// docs/method.md, when a run ends.
inline constexpr int kQuietEvents = 2;
// The same number after coarser levels. [events] docs/method.md, when a run ends.
inline constexpr int kQuietEventsRefined = 1;
// Share of changed nodes up to which an event after coarser levels is quiet. [population_tolerance]
// docs/method.md, when a run ends.
inline constexpr double kRefinedTolerance = 5;
// Share of the expected nodes below which the adjustment continues beyond population_share. [share]
// Chosen.
inline constexpr double kFarTooFew = 0.85;

// ---- Near the boundary ----

// Distance of inner nodes from the boundary in the plane, and of nodes on surfaces from feature
// edges. [d] docs/method.md, near the boundary.
inline constexpr double kBoundaryClearance = 0.4;
// Distance of inner nodes from the boundary in a volume. A layer of regular tetrahedra is 0.82 d
// thick. [d] Measured: with 0.65 and 0.5 the worst tetrahedra are worse.
inline constexpr double kVolumeClearance = 0.75;
// Distance of new nodes from the boundary in a volume. [d] docs/volumes.md.
inline constexpr double kNewNodeClearance = 0.5;
// Clearance below which a node has no room and is deleted, as in a wedge or gap narrower than 0.7
// d. [d] docs/method.md, near the boundary.
inline constexpr double kMinClearance = 0.35;

// ---- Finish in the plane ----

// Minimum length of a boundary edge over which the first row has a node. [d] Chosen:
// docs/method.md, near the boundary.
inline constexpr double kRegularEdgeMin = 0.75;
// Maximum length of a boundary edge over which the first row has a node. [d] Chosen.
inline constexpr double kRegularEdgeMax = 1.3;
// Cosine of the largest turn of the boundary (30 degrees) at the ends of an edge with a node of the
// first row. [cosine] Chosen.
inline constexpr double kRegularTurnCosine = 0.87;
// Distance from the rest of the boundary that points over an edge need for a row of nodes: on the
// way to the first row, in it, and in the second row. [height of the point over the edge] Chosen.
inline constexpr double kApexRoom = 0.75;
// Minimum distance between two nodes of the first row. [edge] Chosen.
inline constexpr double kApexesApart = 0.7;
// Largest decrease of d, inwards or along the boundary, with which a first row is made. [d per d]
// Measured: with 0.1 the first row improves the triangles, with 0.2 it does not.
inline constexpr double kFirstRowMaxFall = 0.15;
// Distance from an apex within which the nearest node moves to the apex and the other nodes are
// deleted. [edge] Measured with kFirstRowDepth.
inline constexpr double kApexTakes = 0.5;
// Distance from boundary edges with an apex within which nodes are in the first row or deleted. The
// first row is at 0.87, the second at 1.73. [edge] Measured: with 1.4, fewer nodes remain than
// there is room for.
inline constexpr double kFirstRowDepth = 1.2;
// Maximum displacement of a node in a sweep. [d] Chosen.
inline constexpr double kSweepMaxMove = 0.1;
// Quality below which a sweep must not make triangles worse. [quality] Chosen.
inline constexpr double kSweepGuardsBelow = 0.75;
// Number of sweeps after which the stars are updated. [sweeps] Chosen.
inline constexpr int kSweepsOnStars = 5;
// Quality below which a centroidal sweep must not make triangles worse. Edge flips between these
// sweeps repair the others. [quality] Chosen below the qualities in Delaunay triangulations of such
// nodes.
inline constexpr double kCentroidalSweepGuardsBelow = 0.3;
// Largest angle above which obtuse_rounds repairs a triangle. [degrees] Chosen below 90.
inline constexpr double kObtuseRepairAngle = 89.5;
// Smallest angle of a triangle that this repair rates as bad as a right angle. [degrees] Chosen:
// the smallest angles are 36 to 41 degrees where d grows by less than 0.1.
inline constexpr double kObtuseRepairMinAngle = 35;
// Number of neighbours up to which a node may be surplus. [neighbours] docs/method.md.
inline constexpr int kFewNeighbours = 4;
// Increase of the minimum quality around a surplus node for which the node is removed. [quality]
// docs/method.md.
inline constexpr double kSurplusPays = 0.02;
// Shape below which triangles are repaired first. [shape] docs/method.md.
inline constexpr double kWorstBelow = 0.82;
// Weight of the sine of the smallest angle in the shape of a triangle. An angle of 38.5 degrees
// then counts as a quality of 0.85. [factor] Derived: 0.85 / sin(38.5 degrees).
inline constexpr double kAngleWeight = 1.365;
// First and largest displacement in the search for a better position of a node of a bad triangle.
// Each further displacement is half as long. [d] Chosen.
inline constexpr double kRepairFirstWay = 0.08;
// Lower bound of these displacements. [d] Chosen.
inline constexpr double kRepairLastWay = 0.01;
// Quality below which a triangle is a topological defect. [quality] docs/method.md.
inline constexpr double kDefectBelow = 0.84;
// Decrease of the sum of (1 - quality)^2 for which a topological change is made. [quality squared]
// docs/method.md.
inline constexpr double kDefectPays = 0.01;
// Minimum distance of a node inserted at a defect from other nodes. [d] Chosen.
inline constexpr double kDefectMinGap = 0.4;
// Distance up to which defects are in the same cluster, of which only the worst is tried. [rings]
// Chosen.
inline constexpr int kClusterRings = 2;
// Maximum distance from a defect of a node that is removed to repair it. [rings] Chosen.
inline constexpr int kSurplusRings = 2;
// Distance beyond which defects are repaired in the same round. [rings] docs/method.md.
inline constexpr int kDefectContestRings = 5;
// Depth of the mesh that is copied around a defect. Nodes of the last ring do not move. [rings]
// docs/method.md.
inline constexpr int kPatchRings = 4;
// Number of relaxation steps on the copy. [steps] Chosen.
inline constexpr int kPatchSteps = 20;
// Number of relaxation steps between edge flips on the copy. [steps] Chosen.
inline constexpr int kPatchStepsBetweenFlips = 5;
// Displacement of a node in a relaxation step. [share of the distance to the mean of its
// neighbours] Chosen.
inline constexpr double kPatchWay = 0.8;

// ---- Finish in space ----

// Distance of inner nodes from the surface in sweeps and repairs. With it, all triangles of the
// surface are faces of elements. [d] Measured.
inline constexpr double kFinishClearance = 0.6;
// The same distance from inner surfaces, which have nodes on both sides. Triangles in their corners
// have circumcircles of radius 0.71 d. [d] Derived.
inline constexpr double kInnerClearance = 0.75;
// Maximum number of rounds of sweeps and repairs, each followed by a refinement of the boundary.
// [rounds] Chosen.
inline constexpr int kMaxFinishRounds = 3;
// Number of sweeps between the two repairs of slivers. [sweeps] Chosen.
inline constexpr int kSweepsBetweenRepairs = 2;
// Dihedral angle below which tetrahedra are repaired first. [degrees] Chosen.
inline constexpr double kFlatBelow = 10;
// Dihedral angle below which tetrahedra are repaired next. [degrees] Chosen.
inline constexpr double kThinBelow = 20;
// Range above sliver_angle in which dihedral angles must not become smaller. [degrees]
// docs/volumes.md: 38 degrees by default.
inline constexpr double kPenaltyAbove = 5;
// Maximum number of rounds of a repair of slivers. [rounds] Chosen.
inline constexpr int kSliverRounds = 100;
// Number of failed attempts at which a repair ends. [share of the nodes] Chosen.
inline constexpr double kMaxInVain = 0.1;
// Cost of an attempt to move a node along a surface. For each position all stars around the node
// are computed. [attempts to move an inner node] Chosen.
inline constexpr int kWorkOfSurfaceMove = 3;
// Number of positions that are tried for a node in an attempt. [trials] Chosen.
inline constexpr int kSliverTrials = 8;
// Minimum distance of these positions from the node. [d] docs/volumes.md.
inline constexpr double kSliverShortestWay = 0.08;
// Maximum distance of these positions from the node. [d] docs/volumes.md.
inline constexpr double kSliverLongestWay = 0.28;
// Number of attempts to move a corner of a sliver for each attempt to move a neighbour of a corner.
// [attempts] Chosen.
inline constexpr int kSliverTurnsOfCorners = 5;
// Distance from a moved node within which all changes of stars lie. [d] Chosen.
inline constexpr double kSliverReach = 1.8;
// Maximum displacement of a node in a whole repair. [d] Chosen.
inline constexpr double kSliverDrift = 0.6;
// Half of the longest edge between nodes at rest. [d] Measured.
inline constexpr double kSliverEdge = 0.9;
// Depth of the stars that an attempt reads, including one ring for nodes that become neighbours.
// [rings] Derived.
inline constexpr int kSliverRings = 4;
// Minimum distance between nodes on the same sheet of the surface in a repair. [d] Chosen.
inline constexpr double kSliverRoom = 0.7;
// Distance up to which a repair that moves a node along the surface considers boundary nodes. [d]
// Derived: the rank has all nodes within this distance.
inline constexpr double kSliverSight = 2.5;
// Dihedral angle below which nodes are removed or inserted at elements that the repairs leave.
// [degrees] Chosen.
inline constexpr double kThinElement = 15;
// Length of an edge between two boundary nodes below which one of them is removed. [d] Derived: if
// the other edges have length d, the opposite angle is at most 29 degrees.
inline constexpr double kShortEdge = 0.5;
// Cosine of the angle (20 degrees) up to which two curves that leave the ends of a short edge run
// beside each other. [1] Chosen.
inline constexpr double kBesideCosine = 0.94;
// Minimum length of the next edges of two such curves. [d] Chosen.
inline constexpr double kBesideLength = 0.5;
// Length of an edge below which it loses a node even between such curves. The curve does not become
// ragged. [d] Chosen.
inline constexpr double kRagged = 0.05;
// Dihedral angle below which a tetrahedron with an undetermined label is excluded from the
// elements, provided that the boundary remains closed. [degrees] Chosen.
inline constexpr double kThinLabel = 10;
// Minimum distance of a node inserted in a flat element from the nodes of the element. [d] Chosen.
inline constexpr double kRoomInSliver = 0.4;
// The same distance if three nodes of the element are on features, which do not move. [d] Chosen.
inline constexpr double kRoomInHeldSliver = 0.2;
// Minimum distance of the inserted node from the surface. [minimum distance from the nodes of
// the element] Chosen.
inline constexpr double kSliverClearance = 0.6;
// Minimum distance between nodes that are inserted in flat elements at the same time. [d] Chosen.
inline constexpr double kSliversApart = 1;
// Maximum number of rounds in which nodes are removed and inserted before the next repair. [rounds]
// Chosen.
inline constexpr int kThinRounds = 3;
// Maximum number of repairs of the remaining thin elements. [repairs] Chosen.
inline constexpr int kThinRepairs = 2;
// Number of thin elements above which these repairs are omitted. Walls and steps much smaller than
// d have so many, and repairs do not help there. [share of the nodes] Chosen.
inline constexpr double kManyThin = 0.02;

// ---- The surface in space ----

// Distance from all nodes above which a point on a surface is vacant. The distance is at most 0.58
// in a lattice and hardly above 0.75 between bubbles at rest. [d] docs/volumes.md.
inline constexpr double kVacant = 0.80;
// Maximum distance of the centre of a vacancy's circumcircle from the surface. [d] Chosen.
inline constexpr double kVacancyBend = 0.3;
// Distance from all nodes taken over from an earlier placement above which a point gets a node
// before bubbles move. In a lattice the distance is at most 0.58 on a surface and 0.61 inside. [d]
// Chosen.
inline constexpr double kGap = 0.8;
// Thickness of walls below which their two sides have nodes opposite each other. [d] Measured:
// tetrahedra between other nodes fill a plate of 0.2 d, but not one of 0.1 d.
inline constexpr double kThinWall = 0.25;
// Width of gaps below which their two sides have nodes opposite each other. Tetrahedra in a gap are
// no elements, so their angles do not matter. [d] Chosen.
inline constexpr double kNarrowGap = 0.5;
// Lateral offset of an opposite node through a wall of thickness t. [t^2/d] Measured: a stack of
// plates of 0.05 d and gaps of 0.03 d conforms with 0.6 and does not with 6.
inline constexpr double kAsideInThinWall = 0.6;
// Minimum distance of an opposite node from feature edges. [d] Chosen.
inline constexpr double kPartnerClearance = 0.3;
// Minimum distance of an opposite node from other nodes. [d] Chosen.
inline constexpr double kPartnerGap = 0.5;
// Distance from the centre of a surface ball within which an existing node replaces the new node of
// the ball. [radius of the ball] Chosen.
inline constexpr double kBallTaken = 0.3;
// Minimum distance between the centres of surface balls that get nodes in a round. [radius of the
// larger ball] Chosen.
inline constexpr double kBallsApart = 0.7;
// Maximum number of rounds that insert nodes at surface balls. [rounds] Chosen.
inline constexpr int kMaxBallRounds = 12;
// Number of these rounds that run even if the number of stray faces does not decrease. [rounds]
// Chosen.
inline constexpr int kBallRoundsAnyway = 2;
// Number of stray faces up to which the number need not decrease. [faces] Chosen.
inline constexpr int kFewStrays = 10;
// Maximum number of rounds in which boundary nodes are inserted and blocking nodes are removed.
// [rounds] Chosen.
inline constexpr int kMaxBoundaryRounds = 8;

// ---- Holding d down in space ----

// Factor by which d is reduced where a round does not conform. [d] docs/volumes.md.
inline constexpr double kHeldTo = 0.5;
// Number of rounds that only apply this factor. In later rounds d also follows the width of narrow
// parts there. [rounds] Measured: of 32 bodies of about five parts that need rounds, at 400 nodes,
// 9 do not conform in the end without these later rounds, and 1 with them.
inline constexpr int kRoundsOfHalves = 1;
// Maximum number of steps of a round with reduced d, whose slope has jumps. [value of the option
// steps] Measured: elephant.off of CGAL, at 3 000 nodes and min_angle 20, rests after 50 to 80
// steps.
inline constexpr int kStepsWhereHeld = 2;
// Dihedral angle below which elements cause a warning if min_angle is 0. [degrees] Default of the
// option min_angle.
inline constexpr double kSmallAngle = 2;
// Share of the small angles that a round may leave to count as progress. [share] Chosen.
inline constexpr double kSmallAnglesLeft = 0.5;
// Maximum number of rounds without progress once a round has conformed. [rounds] Chosen: each takes
// as long as a run.
inline constexpr int kMaxRoundsInVain = 2;
// Maximum number of consecutive rounds without progress while no round has conformed. [rounds]
// Chosen.
inline constexpr int kMaxRoundsInVainToConform = 3;
// Expected number of nodes above which no further round is run. [nodes of the first round] Chosen.
inline constexpr double kMaxGrowthOfNodes = 4;
// The same number if the last round does not conform. [nodes of the first round] Chosen.
inline constexpr double kMaxGrowthToConform = 10;
// Number of nodes that is allowed in this case in any event. [nodes] Chosen.
inline constexpr double kFewNodesToConform = 5000;
// Number of layers of nodes that the option resolve requires in a wall. Layers on its sides count
// half. [layers] Derived: one layer in the middle.
inline constexpr double kLayersInWall = 2;
// The same number for a gap. Nodes of one side must lie outside the spheres around triangles of the
// other. These spheres reach 0.58 d for equilateral triangles, and d between the two sides is
// larger. [layers] Derived.
inline constexpr double kLayersInGap = 4.0 / 3;
// Dihedral angle of the surface below which an edge is sharp. Slivers are repaired up to the same
// angle. [degrees] Default of the option sliver_angle.
inline constexpr double kSharpEdge = 33;
// Distance between the nodes of a surplus piece within which all of them are removed. [d] Chosen.
inline constexpr double kSmallPiece = 0.5;
// Number of rounds before nodes at tips are removed. A further halving of d yields the same
// arrangement there at a smaller scale. [rounds] Chosen.
inline constexpr int kRoundsBeforeTips = 2;
// Distance up to which boundary nodes are beside each other. [d] Equal to kTouch.
inline constexpr double kBeside = 1.3;
// Maximum number of tries with a tree refined at undersampled points. Each try adds the
// surroundings of the points found; two tries mostly suffice. [tries] Chosen.
inline constexpr int kMaxTreeTries = 4;

}  // namespace pnpbs::method
