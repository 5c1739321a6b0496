# Seconds of the longest GoogleTest tests: these start first, so that the last jobs end together. (ctest learns costs from
# previous runs, which a fresh clone lacks.) Tests that no longer exist are ignored.
set(costs
  "PlasticProbe.AResolvedBallHasTaborsPressureAndLeavesADentByElasticUnloading" 25
  "StudyRead.EverythingShippedIsRight" 45
  "Scenes/AfmScene.MeetsItsExpectations/colloid_cu_plastic" 15
  "GluedBar.AnswersAsTheWholeBar" 30
  "HertzBall.TakesHertzsForceRadiusAndPressureWhereItsMeshResolvesThem" 30
  "Scenes/Shipped.KeepsItsEnergyBalance/brittle_crushed_bed_toml" 60
  "Scenes/Shipped.KeepsItsEnergyBalance/periodic_soft_pentagons_toml" 40
  "Scenes/Shipped.KeepsItsEnergyBalance/periodic_soft_discs_toml" 30
  "Scenes/Shipped.KeepsItsEnergyBalance/shear_irregular_powder_toml" 30
  "Scenes/AfmScene.MeetsItsExpectations/loop_v_12_5_kept_height" 10
  "Scenes/AfmScene.MeetsItsExpectations/loop_v_14_kept_height" 10
  "Scenes/AfmScene.MeetsItsExpectations/colloid_316l_plastic" 8
  "ForceCurve.TheTipLeavesWhereTheLeverDrawsWithTheAdhesion" 15)
while(costs)
  list(POP_FRONT costs name cost)
  set_tests_properties("${name}" PROPERTIES COST ${cost})
endwhile()
