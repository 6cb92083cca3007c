# Labels of single tests, read by ctest after it has found them: `threads` are those that look at
# what several threads do, which the thread sanitizer runs in continuous integration; none that needs
# Embree, in which it reports races that are none.
set_tests_properties(
  Environment.BitsDoNotDependOnThreads
  Lighting.BitsDoNotDependOnThreads
  Hemisphere.BitsDoNotDependOnThreads
  Moments.ThreadsAndTargetsAgree
  Distance.BitsDoNotDependOnThreads
  DistanceThreads.BitsDoNotDependOnThreads
  DistanceThreads.NoWorkerWaitsForOneThatHasNotBegun
  DistanceThreads.CancelsOnManyThreads
  VolumeRange.IsThatOfPlainLoopsForAnyThreads
  OcclusionThreads.BitsDoNotDependOnThreads
  OcclusionThreads.NoWorkerWaitsForOneThatHasNotBegun
  OcclusionThreads.CancelsOnManyThreads
  Surface.SameBitsForAnyThreadsAndCloseOnEveryTarget
  TerrainAgreement.SameBitsForAnyNumberOfThreads
  RunThreads.ExecutorsWithoutThreadsAndNumbersOutOfRangeAreRefused
  FarField.BitsDoNotDependOnThreads
  Threads.AnEstimatorThatIsRunningRefusesToRun
  Volumetric.AnyNumberOfThreadsGivesTheSameBits
  Horizon.BitsDoNotDependOnThreads
  Reference.SameBitsForAnyNumberOfThreads
  PROPERTIES LABELS "kernel;threads")
# `slow` are those that take more than ten seconds under a sanitizer and look at results or files, not
# at memory: continuous integration runs them without, the nightly run with the address sanitizer.
set_tests_properties(
  PatternFiles.PatternsAreMadeAsTheyShip
  ThreadsTest.Light
  LightCommandTest.ComparatorsLightThePicture
  LightCommandTest.KeepsTheConvolution
  WorkBoundsTest.LongImages
  EndingsTest.ADamagedCacheChangesNothing
  EndingsTest.EndedAtAnyMoment
  EndingsTest.FullDisks
  VolumePicture.ShowsScansAtFirstGlance
  VulkanBackdrop.MovesNothingBeforeItByAnyMethod
  VulkanHorizon.MatterAgreesForEveryOccluder
  VulkanLight.EverySettingAgreesUnderEverySky
  PROPERTIES LABELS slow)
set_tests_properties(
  FarFieldDirections.AgreeWithTracedOnes
  FarFieldDirections.UniformIntegralCarriesTheVisibility
  FarFieldSharing.StaysNearTheFullEvaluation
  Backdrop.MovesNothingBeforeItByAnyMethod
  FarField.FiniteMatterAgreesWithRays
  Horizon.SlicesAgreeWithRaysThroughTheDepthField
  HorizonMatter.PostsBeforeAWallAgreeWithRays
  HorizonDirections.SlicesAgreeWithRaysThroughTheDepthField
  ModelsOfMatter.InTheScenes
  ModelsOfMatter.OfTheBunny
  Terrain.WallAsHighAsItIsFar
  TruthImages.Hall
  TruthImages.Meadow
  TruthImages.Tower
  PROPERTIES LABELS "kernel;slow")
set_tests_properties(
  Threads.EveryMethodAndOutputHasTheSameBits
  PROPERTIES LABELS "kernel;slow;threads")
