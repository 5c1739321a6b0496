# Seconds of the longest tests that GoogleTest tells of: those start first, so that the last jobs end together. (ctest knows
# them from its runs before, which a fresh clone has not.) One that there is no more is passed over.
set(costs
  "PlasticProbe.AResolvedBallHasTaborsPressureAndLeavesADentByElasticUnloading" 60
  "StudyRead.EverythingShippedIsRight" 45
  "Scenes/AfmScene.MeetsItsExpectations/colloid_cu_plastic" 40
  "GluedBar.AnswersAsTheWholeBar" 30
  "HertzBall.TakesHertzsForceRadiusAndPressureWhereItsMeshResolvesThem" 30
  "Scenes/Shipped.KeepsItsEnergyBalance/brittle_crushed_bed_toml" 60
  "Scenes/Shipped.KeepsItsEnergyBalance/periodic_soft_pentagons_toml" 40
  "Scenes/Shipped.KeepsItsEnergyBalance/periodic_soft_discs_toml" 30
  "Scenes/Shipped.KeepsItsEnergyBalance/shear_irregular_powder_toml" 30
  "Scenes/AfmScene.MeetsItsExpectations/loop_v_12_5_kept_height" 25
  "Scenes/AfmScene.MeetsItsExpectations/loop_v_14_kept_height" 25
  "Scenes/AfmScene.MeetsItsExpectations/colloid_316l_plastic" 20
  "ForceCurve.TheTipLeavesWhereTheLeverDrawsWithTheAdhesion" 20)
while(costs)
  list(POP_FRONT costs name cost)
  set_tests_properties("${name}" PROPERTIES COST ${cost})
endwhile()
