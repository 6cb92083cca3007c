#include "reproduce/bent.h"
#include "reproduce/far_field.h"
#include "reproduce/reproduce.h"
#include "reproduce/sweeps.h"
#include "reproduce/temporal.h"
#include "reproduce/terrain.h"
#include "reproduce/volumetric.h"
#ifdef OBSCURA_WITH_VULKAN
#include "reproduce/vulkan_times.h"
#endif

namespace obscura::tools {

const std::vector<Reproduction>& reproductions() {
  static const std::vector<Reproduction> list = {
      {"vo-table1", "Times and errors of lines, points and areas, single and double radius",
       reproduce_vo_table1},
      {"vo-flicker", "Whether lines flicker less than points", reproduce_vo_flicker},
      {"vo-patterns", "Integration errors of the sample patterns", reproduce_vo_patterns},
      {"ffao-table1", "Times of far field and mipmap at two resolutions", reproduce_ffao_table1},
      {"ffao-table2", "Time of each pass of the far field", reproduce_ffao_table2},
      {"ffao-table3", "Time of the far field against its base interval", reproduce_ffao_table3},
      {"ffao-table4", "Time of each pass where 3x3 pixels share the far field's directions",
       reproduce_ffao_table4},
      {"ffao-fig7", "Errors of far field and mipmap on two scenes, with pictures",
       reproduce_ffao_fig7},
      {"ffao-front", "Errors and times of many settings of the far field", reproduce_ffao_front},
      {"ffao-bars", "Regression thresholds of the far field, each figure beside its threshold",
       reproduce_ffao_bars},
      {"error-vs-time", "Error against time, for the depth image and for the real geometry",
       reproduce_error_vs_time},
      {"temporal", "How much each method changes from frame to frame while the camera moves",
       reproduce_temporal},
      {"bent-overhead",
       "What bent normals and cones cost beside visibility (Klehm et al. 2011, section 5)",
       reproduce_bent_overhead},
      {"bent-fig6", "Light through AO, bent normals and cones against the truth (figure 6)",
       reproduce_bent_fig6},
      {"bent-fig7", "Angles between screen-space and ray-traced bent normals (figure 7)",
       reproduce_bent_fig7},
      {"bent-fig8", "Light through cones against directional occlusion at equal time (figure 8)",
       reproduce_bent_fig8},
      {"sweep-table2",
       "Fast occlusion sweeping, Table 2: time of the sweeps on five sizes of grid.",
       reproduce_sweep_table2},
      {"sweep-error", "Fast occlusion sweeping: error of each transport against Monte Carlo.",
       reproduce_sweep_error},
      {"sweep-fig3", "Fast occlusion sweeping, Figure 3: local light, the sweeps and Monte Carlo.",
       reproduce_sweep_fig3},
      {"sweep-figures", "Fast occlusion sweeping, Figures 4 to 10 on volumes that anyone can make.",
       reproduce_sweep_figures},
      {"terrain-pictures", "Sky views of a hillfort, a city and mountains",
       reproduce_terrain_pictures},
#ifdef OBSCURA_WITH_VULKAN
      {"vulkan-times", "The papers' timing tables on a Vulkan device, pass by pass",
       reproduce_vulkan_times},
      {"vulkan-bars", "Far field against mipmap at equal time on a Vulkan device",
       reproduce_vulkan_bars},
#endif
  };
  return list;
}

}  // namespace obscura::tools
