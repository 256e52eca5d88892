#include <array>

#include "experiments/reproduce/reproduction.h"

namespace plenolab {

ReproductionResult reproduce_scene_overview(Laboratory& laboratory);
ReproductionResult reproduce_visible_pixels(Laboratory& laboratory);
ReproductionResult reproduce_beam_at_frustum_border(Laboratory& laboratory);
ReproductionResult reproduce_restored_sky(Laboratory& laboratory);
ReproductionResult reproduce_thin_branches(Laboratory& laboratory);
ReproductionResult reproduce_light_shafts(Laboratory& laboratory);
ReproductionResult reproduce_mirror_copies(Laboratory& laboratory);
ReproductionResult reproduce_water(Laboratory& laboratory);
ReproductionResult reproduce_cut_shaft(Laboratory& laboratory);
ReproductionResult reproduce_synthesis_quality(Laboratory& laboratory);
ReproductionResult reproduce_naive_neighbours(Laboratory& laboratory);
ReproductionResult reproduce_joint_neighbours(Laboratory& laboratory);
ReproductionResult reproduce_adjusted_neighbours(Laboratory& laboratory);
ReproductionResult reproduce_bilateral_profiles(Laboratory& laboratory);
ReproductionResult reproduce_stable_highlight(Laboratory& laboratory);
ReproductionResult reproduce_border_regions(Laboratory& laboratory);
ReproductionResult reproduce_visibility_borders(Laboratory& laboratory);
ReproductionResult reproduce_desk_adaptation(Laboratory& laboratory);
ReproductionResult reproduce_cellar_adaptation(Laboratory& laboratory);
ReproductionResult reproduce_dunes_adaptation(Laboratory& laboratory);
ReproductionResult reproduce_consistency_table(Laboratory& laboratory);
ReproductionResult reproduce_response_curves(Laboratory& laboratory);
ReproductionResult reproduce_equalisation(Laboratory& laboratory);
ReproductionResult reproduce_trimming(Laboratory& laboratory);
ReproductionResult reproduce_naive_edge(Laboratory& laboratory);
ReproductionResult reproduce_naive_bilateral_view(Laboratory& laboratory);
ReproductionResult reproduce_edge_without_foreground(Laboratory& laboratory);
ReproductionResult reproduce_enhanced_edge(Laboratory& laboratory);
ReproductionResult reproduce_enhanced_bilateral_view(Laboratory& laboratory);
ReproductionResult reproduce_visibility_threshold(Laboratory& laboratory);
ReproductionResult reproduce_numbers_of_trimmings(Laboratory& laboratory);
ReproductionResult reproduce_adaptation_in_time(Laboratory& laboratory);
ReproductionResult reproduce_synthesis_sweep(Laboratory& laboratory);
ReproductionResult reproduce_tone_mapping_sweep(Laboratory& laboratory);
ReproductionResult reproduce_pruning(Laboratory& laboratory);
ReproductionResult reproduce_flattened_outdoors(Laboratory& laboratory);
ReproductionResult reproduce_unused_range(Laboratory& laboratory);
ReproductionResult reproduce_dark_floor(Laboratory& laboratory);
ReproductionResult reproduce_claim_t11(Laboratory& laboratory);
ReproductionResult reproduce_pruning_tone_mapping(Laboratory& laboratory);
ReproductionResult reproduce_claim_s1(Laboratory& laboratory);
ReproductionResult reproduce_lens_grid(Laboratory& laboratory);
ReproductionResult reproduce_angles_over_depth(Laboratory& laboratory);
ReproductionResult reproduce_confirmed_field_of_view(Laboratory& laboratory);
ReproductionResult reproduce_screen_scale(Laboratory& laboratory);
ReproductionResult reproduce_field_of_view_conflict(Laboratory& laboratory);
ReproductionResult reproduce_calibration_coverage(Laboratory& laboratory);
ReproductionResult reproduce_calibration_stability(Laboratory& laboratory);
ReproductionResult reproduce_claim_g1(Laboratory& laboratory);
ReproductionResult reproduce_claim_g2(Laboratory& laboratory);
ReproductionResult reproduce_claim_g3(Laboratory& laboratory);
ReproductionResult reproduce_claim_g4(Laboratory& laboratory);
ReproductionResult reproduce_claim_g5(Laboratory& laboratory);
ReproductionResult reproduce_claim_g6(Laboratory& laboratory);
ReproductionResult reproduce_claim_g7(Laboratory& laboratory);
ReproductionResult reproduce_claim_g8(Laboratory& laboratory);
ReproductionResult reproduce_claim_a1(Laboratory& laboratory);
ReproductionResult reproduce_claim_a2(Laboratory& laboratory);
ReproductionResult reproduce_claim_a3(Laboratory& laboratory);
ReproductionResult reproduce_claim_a4(Laboratory& laboratory);
ReproductionResult reproduce_claim_a5(Laboratory& laboratory);
ReproductionResult reproduce_claim_a6(Laboratory& laboratory);
ReproductionResult reproduce_claim_t1(Laboratory& laboratory);
ReproductionResult reproduce_claim_t4(Laboratory& laboratory);
ReproductionResult reproduce_claim_t5(Laboratory& laboratory);
ReproductionResult reproduce_claim_t6(Laboratory& laboratory);
ReproductionResult reproduce_claim_t7(Laboratory& laboratory);
ReproductionResult reproduce_claim_t8(Laboratory& laboratory);
ReproductionResult reproduce_claim_t9(Laboratory& laboratory);
ReproductionResult reproduce_claim_t10(Laboratory& laboratory);
ReproductionResult reproduce_claim_t12(Laboratory& laboratory);
ReproductionResult reproduce_claim_t13(Laboratory& laboratory);
ReproductionResult reproduce_claim_t14(Laboratory& laboratory);
ReproductionResult reproduce_claim_t2(Laboratory& laboratory);
ReproductionResult reproduce_claim_t3(Laboratory& laboratory);
ReproductionResult reproduce_robust_operator(Laboratory& laboratory);
ReproductionResult reproduce_circle_of_confusion(Laboratory& laboratory);
ReproductionResult reproduce_hole_fills(Laboratory& laboratory);
ReproductionResult reproduce_centre_subimages(Laboratory& laboratory);
ReproductionResult reproduce_extreme_occlusion(Laboratory& laboratory);
ReproductionResult reproduce_edge_differences(Laboratory& laboratory);
ReproductionResult reproduce_largest_differences(Laboratory& laboratory);
ReproductionResult reproduce_mean_differences(Laboratory& laboratory);
ReproductionResult reproduce_median_differences(Laboratory& laboratory);
ReproductionResult reproduce_performance_test(Laboratory& laboratory);
ReproductionResult reproduce_first_experiment(Laboratory& laboratory);
ReproductionResult reproduce_difference_images(Laboratory& laboratory);
ReproductionResult reproduce_claim_h2(Laboratory& laboratory);
ReproductionResult reproduce_claim_h3(Laboratory& laboratory);
ReproductionResult reproduce_claim_h4(Laboratory& laboratory);
ReproductionResult reproduce_claim_h5(Laboratory& laboratory);
ReproductionResult reproduce_claim_h6(Laboratory& laboratory);
ReproductionResult reproduce_claim_h7(Laboratory& laboratory);
ReproductionResult reproduce_claim_h8(Laboratory& laboratory);
ReproductionResult reproduce_claim_h9(Laboratory& laboratory);
ReproductionResult reproduce_claim_h10(Laboratory& laboratory);
ReproductionResult reproduce_claim_h11(Laboratory& laboratory);
ReproductionResult reproduce_claim_h12(Laboratory& laboratory);
ReproductionResult reproduce_study_table(Laboratory& laboratory);
ReproductionResult reproduce_initial_study_table(Laboratory& laboratory);
ReproductionResult reproduce_study_figure(Laboratory& laboratory);
ReproductionResult reproduce_study_planning(Laboratory& laboratory);
ReproductionResult reproduce_simulated_study(Laboratory& laboratory);
ReproductionResult reproduce_run_time_test(Laboratory& laboratory);
ReproductionResult reproduce_claim_h1(Laboratory& laboratory);
ReproductionResult reproduce_claim_h13(Laboratory& laboratory);
ReproductionResult reproduce_pillars_views(Laboratory& laboratory);
ReproductionResult reproduce_estimated_luminance(Laboratory& laboratory);
ReproductionResult reproduce_psnr_along_the_line(Laboratory& laboratory);
ReproductionResult reproduce_sphere_mapped(Laboratory& laboratory);
ReproductionResult reproduce_pillars_mapped(Laboratory& laboratory);
ReproductionResult reproduce_claim_d1(Laboratory& laboratory);
ReproductionResult reproduce_claim_d2(Laboratory& laboratory);
ReproductionResult reproduce_claim_d3(Laboratory& laboratory);
ReproductionResult reproduce_claim_d4(Laboratory& laboratory);
ReproductionResult reproduce_claim_d5(Laboratory& laboratory);
ReproductionResult reproduce_claim_d6(Laboratory& laboratory);
ReproductionResult reproduce_claim_d7(Laboratory& laboratory);
ReproductionResult reproduce_colour_transfer(Laboratory& laboratory);
ReproductionResult reproduce_walk(Laboratory& laboratory);
ReproductionResult reproduce_turns(Laboratory& laboratory);
ReproductionResult reproduce_mixed_images(Laboratory& laboratory);
ReproductionResult reproduce_counting_times(Laboratory& laboratory);
ReproductionResult reproduce_claim_z4(Laboratory& laboratory);
ReproductionResult reproduce_claim_z5(Laboratory& laboratory);
ReproductionResult reproduce_claim_z6(Laboratory& laboratory);
ReproductionResult reproduce_claim_z7(Laboratory& laboratory);

ReproductionResult reproduce_linear_and_designed(Laboratory& laboratory);
ReproductionResult reproduce_adapted_slopes(Laboratory& laboratory);
ReproductionResult reproduce_lut_storage(Laboratory& laboratory);
ReproductionResult reproduce_natural_histograms(Laboratory& laboratory);
ReproductionResult reproduce_game_histograms(Laboratory& laboratory);
ReproductionResult reproduce_sky_flicker(Laboratory& laboratory);
ReproductionResult reproduce_pq_curve(Laboratory& laboratory);
ReproductionResult reproduce_generic_parameters(Laboratory& laboratory);
ReproductionResult reproduce_tuned_images(Laboratory& laboratory);
ReproductionResult reproduce_tuned_table(Laboratory& laboratory);
ReproductionResult reproduce_tuning_audit(Laboratory& laboratory);
ReproductionResult reproduce_game_sequence(Laboratory& laboratory);
ReproductionResult reproduce_claim_z1(Laboratory& laboratory);
ReproductionResult reproduce_claim_z2(Laboratory& laboratory);
ReproductionResult reproduce_claim_z3(Laboratory& laboratory);

std::span<const Reproduction> reproductions() {
  static constexpr std::array kItems{
      Reproduction{"altmeier-fig-11", "Figure 11: the scenes", Chapter::kScenes, reproduce_scene_overview},
      Reproduction{"altmeier-fig-16", "Figure 16: visible pixels in warped key views", Chapter::kGeometry,
                   reproduce_visible_pixels},
      Reproduction{"altmeier-fig-31", "Figure 31: background that no key view shows", Chapter::kGeometry,
                   reproduce_beam_at_frustum_border},
      Reproduction{"altmeier-fig-32", "Figure 32: restored sky", Chapter::kGeometry, reproduce_restored_sky},
      Reproduction{"altmeier-fig-33", "Figure 33: thin branches are lost", Chapter::kGeometry,
                   reproduce_thin_branches},
      Reproduction{"altmeier-fig-34", "Figure 34: copies of light shafts", Chapter::kAppearance,
                   reproduce_light_shafts},
      Reproduction{"altmeier-fig-35", "Figure 35: copies of reflections", Chapter::kAppearance,
                   reproduce_mirror_copies},
      Reproduction{"altmeier-fig-36", "Figure 36: rippled water", Chapter::kAppearance, reproduce_water},
      Reproduction{"altmeier-fig-37", "Figure 37: a light shaft cut off", Chapter::kAppearance,
                   reproduce_cut_shaft},
      Reproduction{"synthesis-quality", "Synthesised views against ground truth", Chapter::kQuality,
                   reproduce_synthesis_quality},
      Reproduction{"altmeier-fig-3", "Figure 3: response curves of Reinhard & Devlin", Chapter::kOperators,
                   reproduce_response_curves},
      Reproduction{"altmeier-fig-4", "Figure 4: histogram equalisation", Chapter::kOperators,
                   reproduce_equalisation},
      Reproduction{"altmeier-fig-5", "Figure 5: trimming of the histogram", Chapter::kOperators,
                   reproduce_trimming},
      Reproduction{"altmeier-fig-21", "Figure 21: an edge through the naive bilateral operator",
                   Chapter::kOperators, reproduce_naive_edge},
      Reproduction{"altmeier-fig-22", "Figure 22: the naive bilateral operator on a key view",
                   Chapter::kOperators, reproduce_naive_bilateral_view},
      Reproduction{"altmeier-fig-23", "Figure 23: an edge without foreground layer", Chapter::kOperators,
                   reproduce_edge_without_foreground},
      Reproduction{"altmeier-fig-24", "Figure 24: an edge through the enhanced bilateral operator",
                   Chapter::kOperators, reproduce_enhanced_edge},
      Reproduction{"altmeier-fig-25", "Figure 25: the enhanced bilateral operator on a key view",
                   Chapter::kOperators, reproduce_enhanced_bilateral_view},
      Reproduction{"altmeier-fig-26", "Figure 26: the smallest visible difference", Chapter::kOperators,
                   reproduce_visibility_threshold},
      Reproduction{"altmeier-fig-27", "Figure 27: numbers of trimming passes", Chapter::kOperators,
                   reproduce_numbers_of_trimmings},
      Reproduction{"altmeier-fig-45", "Figure 45: histogram adjustment between indoors and outdoors",
                   Chapter::kOperators, reproduce_flattened_outdoors},
      Reproduction{"altmeier-fig-46", "Figure 46: bilateral filtering leaves range unused",
                   Chapter::kOperators, reproduce_unused_range},
      Reproduction{"altmeier-fig-47", "Figure 47: Reinhard 2005 beside direct sun", Chapter::kOperators,
                   reproduce_dark_floor},
      Reproduction{"tone-mapping-consistency", "Consistency of every operator over camera motions",
                   Chapter::kConsistency, reproduce_consistency_table},
      Reproduction{"altmeier-fig-28", "Figure 28: neighbouring key views, mapped naively",
                   Chapter::kConsistency, reproduce_naive_neighbours},
      Reproduction{"altmeier-fig-29", "Figure 29: neighbouring key views, joint statistics",
                   Chapter::kConsistency, reproduce_joint_neighbours},
      Reproduction{"altmeier-fig-30", "Figure 30: neighbouring key views, adjusted", Chapter::kConsistency,
                   reproduce_adjusted_neighbours},
      Reproduction{"altmeier-fig-38",
                   "Figure 38: profiles of the bilateral operator at borders of visibility",
                   Chapter::kConsistency, reproduce_bilateral_profiles},
      Reproduction{"altmeier-fig-39", "Figure 39: a stable highlight keeps naive mapping consistent",
                   Chapter::kConsistency, reproduce_stable_highlight},
      Reproduction{"altmeier-fig-40", "Figure 40: border regions of key views", Chapter::kConsistency,
                   reproduce_border_regions},
      Reproduction{"altmeier-fig-41", "Figure 41: borders of visibility", Chapter::kConsistency,
                   reproduce_visibility_borders},
      Reproduction{"altmeier-fig-42", "Figure 42: adaptation over a motion, Desk", Chapter::kConsistency,
                   reproduce_desk_adaptation},
      Reproduction{"altmeier-fig-43", "Figure 43: adaptation over a motion, Cellar", Chapter::kConsistency,
                   reproduce_cellar_adaptation},
      Reproduction{"altmeier-fig-44", "Figure 44: adaptation over a motion, Dunes", Chapter::kConsistency,
                   reproduce_dunes_adaptation},
      Reproduction{"robust-operator", "Beyond the thesis: an operator that adapts and does not flicker",
                   Chapter::kConsistency, reproduce_robust_operator},
      Reproduction{"adaptation-in-time", "Adaptation in time: frame rates, ramps and long steps",
                   Chapter::kConsistency, reproduce_adaptation_in_time},
      Reproduction{"hansen-fig-3.2", "Figure 3.2: circle of confusion", Chapter::kDisplay,
                   reproduce_circle_of_confusion},
      Reproduction{"hansen-fig-3.8", "Figure 3.8: ways to fill holes", Chapter::kDisplay,
                   reproduce_hole_fills},
      Reproduction{"hansen-fig-5.1", "Figure 5.1: centre subimages of five scenes", Chapter::kDisplay,
                   reproduce_centre_subimages},
      Reproduction{"hansen-table-5.2", "Table 5.2: largest differences", Chapter::kDisplay,
                   reproduce_largest_differences},
      Reproduction{"hansen-table-5.3", "Table 5.3: mean differences", Chapter::kDisplay,
                   reproduce_mean_differences},
      Reproduction{"hansen-table-5.4", "Table 5.4: median differences", Chapter::kDisplay,
                   reproduce_median_differences},
      Reproduction{"hansen-fig-5.3", "Figure 5.3: extreme occlusion", Chapter::kDisplay,
                   reproduce_extreme_occlusion},
      Reproduction{"hansen-fig-5.4", "Figure 5.4: edges and textures", Chapter::kDisplay,
                   reproduce_edge_differences},
      Reproduction{"hansen-test-5.1", "Performance test 5.1: reprojection against rendering every camera",
                   Chapter::kDisplay, reproduce_performance_test},
      Reproduction{"hansen-fig-e.2", "Figure E.2: without supersampling, with black holes", Chapter::kDisplay,
                   reproduce_first_experiment},
      Reproduction{"hansen-fig-f.1", "Figure F.1: difference images", Chapter::kDisplay,
                   reproduce_difference_images},
      Reproduction{"hansen-table-5.1", "Table 5.1: choices of 34 participants", Chapter::kStudy,
                   reproduce_study_table},
      Reproduction{"hansen-fig-5.2", "Figure 5.2 (figure 6 of the paper): choices and the critical number",
                   Chapter::kStudy, reproduce_study_figure},
      Reproduction{"hansen-table-e", "Appendix E: the initial experiment", Chapter::kStudy,
                   reproduce_initial_study_table},
      Reproduction{"study-planning",
                   "Beyond the thesis: what the test can tell, and how many participants it takes",
                   Chapter::kStudy, reproduce_study_planning},
      Reproduction{"simulated-study", "Beyond the thesis: its study with simulated participants",
                   Chapter::kStudy, reproduce_simulated_study},
      Reproduction{"hansen-run-time-test", "Section 5.1: the run times tested again", Chapter::kStudy,
                   reproduce_run_time_test},
      Reproduction{"hansen-fig-b.1", "Figure B.1: lens grid against pixel grid", Chapter::kCalibration,
                   reproduce_lens_grid},
      Reproduction{"hansen-fig-c.3", "Figure C.3: what a wrong field of view does over depth",
                   Chapter::kCalibration, reproduce_angles_over_depth},
      Reproduction{"hansen-fig-c.4", "Figure C.4: how sharply two spheres confirm a field of view",
                   Chapter::kCalibration, reproduce_confirmed_field_of_view},
      Reproduction{"hansen-fig-d.1", "Figure D.1: sharpness over the screen scale", Chapter::kCalibration,
                   reproduce_screen_scale},
      Reproduction{"hansen-calibration-coverage", "Do intervals of the calibration hold the truth?",
                   Chapter::kCalibration, reproduce_calibration_coverage},
      Reproduction{"hansen-calibration-stability", "Calibration as the panel reaches the focal length",
                   Chapter::kCalibration, reproduce_calibration_stability},
      Reproduction{"hansen-fov-conflict",
                   "Claim H-10: 17.28° calculated, 19.86° measured, smaller subimages sharp",
                   Chapter::kCalibration, reproduce_field_of_view_conflict},
      Reproduction{"doronin-fig-2", "Figure 2: Pillars in HDR from three positions", Chapter::kLuminance,
                   reproduce_pillars_views},
      Reproduction{"doronin-fig-3", "Figure 3: estimated luminance along the observers' line",
                   Chapter::kLuminance, reproduce_estimated_luminance},
      Reproduction{"doronin-fig-4", "Figure 4: PSNR along the observers' line", Chapter::kLuminance,
                   reproduce_psnr_along_the_line},
      Reproduction{"doronin-fig-5", "Figure 5: Sphere, tone mapped with each estimate", Chapter::kLuminance,
                   reproduce_sphere_mapped},
      Reproduction{"doronin-fig-6", "Figure 6: Pillars, tone mapped with each estimate", Chapter::kLuminance,
                   reproduce_pillars_mapped},
      Reproduction{"doronin-claim-d1", "Claim D-1: luminance by position beats one global value",
                   Chapter::kLuminance, reproduce_claim_d1},
      Reproduction{"doronin-claim-d2", "Claim D-2: accumulation follows small moves more strongly",
                   Chapter::kLuminance, reproduce_claim_d2},
      Reproduction{"doronin-claim-d3", "Claim D-3: brute force is noticeably better in certain areas only",
                   Chapter::kLuminance, reproduce_claim_d3},
      Reproduction{"doronin-claim-d4", "Claim D-4: accumulation in real time, brute force far slower",
                   Chapter::kLuminance, reproduce_claim_d4},
      Reproduction{"doronin-claim-d5", "Claim D-5: spread accumulation equals brute force",
                   Chapter::kLuminance, reproduce_claim_d5},
      Reproduction{"doronin-claim-d6", "Claim D-6: the display loses detail away from its screen",
                   Chapter::kLuminance, reproduce_claim_d6},
      Reproduction{"doronin-claim-d7",
                   "Claim D-7: All is worst in Sphere, Accumulative slightly better in Pillars",
                   Chapter::kLuminance, reproduce_claim_d7},
      Reproduction{"zhao-fig-1", "Figure 1: linear against designed tone mapping", Chapter::kOptimisation,
                   reproduce_linear_and_designed},
      Reproduction{"zhao-fig-3", "Figure 3: slopes of the content adaptive operator", Chapter::kOptimisation,
                   reproduce_adapted_slopes},
      Reproduction{"zhao-table-1", "Table 1: parameters of the generic operator", Chapter::kOptimisation,
                   reproduce_generic_parameters},
      Reproduction{"zhao-fig-5", "Figure 5: histograms of photographs", Chapter::kOptimisation,
                   reproduce_natural_histograms},
      Reproduction{"zhao-fig-6", "Figure 6: histograms of rendered game content", Chapter::kOptimisation,
                   reproduce_game_histograms},
      Reproduction{"zhao-fig-7", "Figure 7: perceptual quantisation against gamma 2.4",
                   Chapter::kOptimisation, reproduce_pq_curve},
      Reproduction{"zhao-fig-9", "Figure 9: flicker from a small change of the sky", Chapter::kOptimisation,
                   reproduce_sky_flicker},
      Reproduction{"zhao-fig-15", "Figure 15: game-like frames by three methods", Chapter::kOptimisation,
                   reproduce_tuned_images},
      Reproduction{"zhao-table-2", "Table 2: DRIM distortion of ten game-like sequences",
                   Chapter::kOptimisation, reproduce_tuned_table},
      Reproduction{"zhao-audit-table-2", "Table 2 and figure 15 held against themselves",
                   Chapter::kOptimisation, reproduce_tuning_audit},
      Reproduction{"zhao-fig-16", "Figure 16: nine frames of a sequence", Chapter::kOptimisation,
                   reproduce_game_sequence},
      Reproduction{"zhao-claim-z1", "Claim Z-1: rendered content has spikier histograms than photographs",
                   Chapter::kOptimisation, reproduce_claim_z1},
      Reproduction{"zhao-claim-z2", "Claim Z-2: less DRIM distortion by the content adaptive metric",
                   Chapter::kOptimisation, reproduce_claim_z2},
      Reproduction{"zhao-claim-z3", "Claim Z-3: a better no-reference score in every scene",
                   Chapter::kOptimisation, reproduce_claim_z3},
      Reproduction{"zhao-fig-12", "Figure 12: ways of storing look-up tables", Chapter::kLuts,
                   reproduce_lut_storage},
      Reproduction{"zhao-fig-23", "Figure 23: looks by colour transfer", Chapter::kLuts,
                   reproduce_colour_transfer},
      Reproduction{"zhao-fig-24", "Figure 24: a walk through three volumes", Chapter::kLuts, reproduce_walk},
      Reproduction{"zhao-fig-25", "Figure 25: blends beside the table of the volume ahead", Chapter::kLuts,
                   reproduce_turns},
      Reproduction{"zhao-fig-26", "Figure 26: blends beside mixed images", Chapter::kLuts,
                   reproduce_mixed_images},
      Reproduction{"zhao-table-3", "Table 3: times of counting pixels", Chapter::kLuts,
                   reproduce_counting_times},
      Reproduction{"zhao-claim-z4", "Claim Z-4: pixel-based blends are closer to the reference",
                   Chapter::kLuts, reproduce_claim_z4},
      Reproduction{"zhao-claim-z5", "Claim Z-5: what resolution costs", Chapter::kLuts, reproduce_claim_z5},
      Reproduction{"zhao-claim-z6", "Claim Z-6: a table is a hundred times cheaper", Chapter::kLuts,
                   reproduce_claim_z6},
      Reproduction{"zhao-claim-z7", "Claim Z-7: codes in the dark of PQ and gamma", Chapter::kOperators,
                   reproduce_claim_z7},
      Reproduction{"sweep-synthesis", "Error against run time of view synthesis", Chapter::kSpeed,
                   reproduce_synthesis_sweep},
      Reproduction{"pruning", "What was left out, and what that saved", Chapter::kSpeed, reproduce_pruning},
      Reproduction{"sweep-tone-mapping", "Error against run time of tone mapping", Chapter::kSpeed,
                   reproduce_tone_mapping_sweep},
      Reproduction{"pruning-tone-mapping", "What tone mapping left out, and what that saved", Chapter::kSpeed,
                   reproduce_pruning_tone_mapping},
      Reproduction{"altmeier-claim-g1", "Claim A-G1: one pixel is the coarsest acceptable search step",
                   Chapter::kClaims, reproduce_claim_g1},
      Reproduction{"altmeier-claim-g2",
                   "Claim A-G2: below the image size, the search starts inside a key view", Chapter::kClaims,
                   reproduce_claim_g2},
      Reproduction{"altmeier-claim-g3", "Claim A-G3: structures thinner than 2 × 2 px vanish",
                   Chapter::kClaims, reproduce_claim_g3},
      Reproduction{"altmeier-claim-g4", "Claim A-G4: one convex occluder leaves nothing unseen",
                   Chapter::kClaims, reproduce_claim_g4},
      Reproduction{"altmeier-claim-g5",
                   "Claim A-G5: several occluders, even convex ones, leave points unseen", Chapter::kClaims,
                   reproduce_claim_g5},
      Reproduction{"altmeier-claim-g6",
                   "Claim A-G6: restoration looks right before a uniform background only", Chapter::kClaims,
                   reproduce_claim_g6},
      Reproduction{"altmeier-claim-g7",
                   "Claim A-G7: one convex occluder partly outside the frustums leaves points unseen",
                   Chapter::kClaims, reproduce_claim_g7},
      Reproduction{"altmeier-claim-g8", "Claim A-G8: filled slits before a uniform background look right",
                   Chapter::kClaims, reproduce_claim_g8},
      Reproduction{"altmeier-claim-a1", "Claim A-A1: on a key view the output is that key view",
                   Chapter::kClaims, reproduce_claim_a1},
      Reproduction{"altmeier-claim-a2", "Claim A-A2: diffuse surfaces are reproduced, glossy ones are copied",
                   Chapter::kClaims, reproduce_claim_a2},
      Reproduction{"altmeier-claim-a3", "Claim A-A3: denser key views lower the error of glossy surfaces",
                   Chapter::kClaims, reproduce_claim_a3},
      Reproduction{"altmeier-claim-a4", "Claim A-A4: volumetric light appears in copies and is cut off",
                   Chapter::kClaims, reproduce_claim_a4},
      Reproduction{"altmeier-claim-a5", "Claim A-A5: ripples and a denser grid hide copies of reflections",
                   Chapter::kClaims, reproduce_claim_a5},
      Reproduction{"altmeier-claim-a6",
                   "Claim A-A6: linear border gradients leave edges, printed ones do not", Chapter::kClaims,
                   reproduce_claim_a6},
      Reproduction{"altmeier-claim-t1", "Claim A-T1: Cornsweet profiles at borders of visibility",
                   Chapter::kClaims, reproduce_claim_t1},
      Reproduction{"altmeier-claim-t2",
                   "Claim A-T2: the foreground layer returns part of the contrast across depth edges",
                   Chapter::kClaims, reproduce_claim_t2},
      Reproduction{"altmeier-claim-t3",
                   "Claim A-T3: histogram adjustment is consistent in bright scenes, less so in dark ones",
                   Chapter::kClaims, reproduce_claim_t3},
      Reproduction{"altmeier-claim-t4",
                   "Claim A-T4: naive Reinhard 2005 differs between neighbouring key views", Chapter::kClaims,
                   reproduce_claim_t4},
      Reproduction{"altmeier-claim-t5", "Claim A-T5: stable highlights and gradual change leave no steps",
                   Chapter::kClaims, reproduce_claim_t5},
      Reproduction{"altmeier-claim-t6", "Claim A-T6: joint statistics remove inconsistency and adaptation",
                   Chapter::kClaims, reproduce_claim_t6},
      Reproduction{"altmeier-claim-t7", "Claim A-T7: mapping after synthesis is consistent inside the view",
                   Chapter::kClaims, reproduce_claim_t7},
      Reproduction{"altmeier-claim-t8", "Claim A-T8: outliers over time", Chapter::kClaims,
                   reproduce_claim_t8},
      Reproduction{"altmeier-claim-t9", "Claim A-T9: adaptation before and at the event", Chapter::kClaims,
                   reproduce_claim_t9},
      Reproduction{"altmeier-claim-t10", "Claim A-T10: what key-view adjustment lowers, keeps and loses",
                   Chapter::kClaims, reproduce_claim_t10},
      Reproduction{"altmeier-claim-t11", "Claim A-T11: where each operator fails", Chapter::kClaims,
                   reproduce_claim_t11},
      Reproduction{"altmeier-claim-t12", "Claim A-T12: adaptation to the sun of the Dunes", Chapter::kClaims,
                   reproduce_claim_t12},
      Reproduction{"altmeier-claim-t13", "Claim A-T13: a denser grid makes outliers worse", Chapter::kClaims,
                   reproduce_claim_t13},
      Reproduction{"altmeier-claim-t14", "Claim A-T14: fast motion", Chapter::kClaims, reproduce_claim_t14},
      Reproduction{"hansen-claim-h1", "Claim H-1: images 1 to 4 pass, image 5 fails", Chapter::kClaims,
                   reproduce_claim_h1},
      Reproduction{"hansen-claim-h13", "Claim H-13: the mean difference does not predict choices",
                   Chapter::kClaims, reproduce_claim_h13},
      Reproduction{"altmeier-claim-s1", "Claim A-S1: which stages are interactive, which run in real time",
                   Chapter::kClaims, reproduce_claim_s1},
      Reproduction{"hansen-claim-h2", "Claim H-2: differences concentrate at edges and occlusions",
                   Chapter::kClaims, reproduce_claim_h2},
      Reproduction{"hansen-claim-h3", "Claim H-3: a fifth camera removes many holes", Chapter::kClaims,
                   reproduce_claim_h3},
      Reproduction{"hansen-claim-h4", "Claim H-4: mean colours fill holes better than repeated edges",
                   Chapter::kClaims, reproduce_claim_h4},
      Reproduction{"hansen-claim-h5", "Claim H-5: no match is off by more than half a pixel",
                   Chapter::kClaims, reproduce_claim_h5},
      Reproduction{"hansen-claim-h6", "Claim H-6: reprojection is slower than direct rendering",
                   Chapter::kClaims, reproduce_claim_h6},
      Reproduction{"hansen-claim-h7", "Claim H-7: higher resolution lowers the share of wrong pixels",
                   Chapter::kClaims, reproduce_claim_h7},
      Reproduction{"hansen-claim-h8", "Claim H-8: depth needs more than eight bits", Chapter::kClaims,
                   reproduce_claim_h8},
      Reproduction{"hansen-claim-h9", "Claim H-9: anti-aliased corner views break matching", Chapter::kClaims,
                   reproduce_claim_h9},
      Reproduction{"hansen-claim-h10", "Claim H-10: the printed numbers of the optics", Chapter::kClaims,
                   reproduce_claim_h10},
      Reproduction{"hansen-claim-h11", "Claim H-11: one step gives what two steps give", Chapter::kClaims,
                   reproduce_claim_h11},
      Reproduction{"hansen-claim-h12", "Claim H-12: supersampling hardly costs time", Chapter::kClaims,
                   reproduce_claim_h12},
  };
  return kItems;
}

}  // namespace plenolab
