# Labels of single tests, read by ctest after it has found them: `threads` are those that look at
# what several threads do, which the thread sanitizer runs in continuous integration.
set_tests_properties(
  Scenes.SameSeedSameBitsForAnyNumberOfThreads
  Geometric.SameBitsForAnyNumberOfThreads
  CommandTest.AnyThreadCountGivesTheSameBytes
  PROPERTIES LABELS threads)
set_tests_properties(
  Environment.BitsDoNotDependOnThreads
  Lighting.BitsDoNotDependOnThreads
  Hemisphere.BitsDoNotDependOnThreads
  Moments.ThreadsAndTargetsAgree
  Distance.BitsDoNotDependOnThreads
  VolumeRange.IsThatOfPlainLoopsForAnyThreads
  Occlusion.BitsDoNotDependOnThreads
  Surface.SameBitsForAnyThreadsAndCloseOnEveryTarget
  RunThreads.ExecutorsWithoutThreadsAndNumbersOutOfRangeAreRefused
  FarField.BitsDoNotDependOnThreads
  Threads.EveryMethodAndOutputHasTheSameBits
  Threads.AnEstimatorThatIsRunningRefusesToRun
  Volumetric.AnyNumberOfThreadsGivesTheSameBits
  Horizon.BitsDoNotDependOnThreads
  Reference.SameBitsForAnyNumberOfThreads
  PROPERTIES LABELS "kernel;threads")
