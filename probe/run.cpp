#include <cstdio>
#include "fusion/pipeline.h"
#include "graph/graph_io.h"
using namespace curvefusion;
int main(int c,char**v){ setlinebuf(stdout); Sequence s=OpenSequence(v[1]); PipelineOptions o=ProfileOptions(c>3&&std::string(v[3])=="paper"?Profile::kPaper:Profile::kBest);
 PipelineObserver obs; Reconstruction r=Reconstruct(s,o,obs); for(auto&g:r.stages){printf("%s %.2f s",g.name.c_str(),g.seconds);for(auto&[n,x]:g.counts)printf("  %s %g",n.c_str(),x);printf("\n");}
 for(auto&w:r.warnings)printf("warning: %s\n",w.c_str());
 printf("edges %d nodes %d comps %d cycles %d radius %.2f mm\n",r.skeleton.edge_count(),r.skeleton.node_count(),r.skeleton.ComponentCount(),r.skeleton.CycleRank(),r.global_radius*1e3);
 WriteSkeleton(v[2], r.skeleton); }
