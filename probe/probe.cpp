// probe SEQ OUTDIR [every] : integrate, segment, dump per-bundle points (world) as text: x y z rx ry rz count bundle ; and mask pictures of some frames
#include <chrono>
#include <cstdio>
#include <fstream>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include "capture/frame_stream.h"
#include "fusion/segmentation.h"
#include "kernel/parallel.h"
using namespace curvefusion;
static double now(){return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();}
int main(int c,char**v){ setlinebuf(stdout);
  Sequence s=OpenSequence(v[1]); std::string out=v[2]; std::filesystem::create_directories(out);
  SegmentationOptions o; TsdfOptions t; bool best=c>3&&std::string(v[3])=="best"; int every=1;
  if(best){ t.voxel_size=.01; every=2; o.render_divisor=2; o.difference.front_distance=.02;o.difference.silhouette_margin_px=6;o.difference.accept_where_nothing_rendered=false;o.difference.min_neighbours=8;o.bundle.min_frames=3;o.ghosts.verified_outline=0.35;o.ghosts.verified_share=0;o.edges.tolerance_px=2;}
  if(c>4) every=atoi(v[4]);
  TsdfVolume vol(t); double a=now();
  std::vector<int> fr; for(int i=0;i<s.frame_count();i+=every) fr.push_back(i);
  ForEachFrame(s,fr,{true,false},[&](const DecodedFrame&f){vol.Integrate(f.depth,s.depth_camera,s.frames[f.index].T_world_camera);});
  printf("integrate %.2f s, %zu blocks %.1f MB\n",now()-a,vol.block_count(),vol.memory_bytes()/1e6); a=now();
  int b=0; FILE*F=fopen((out+"/points.txt").c_str(),"w"); FILE*G=fopen((out+"/diffset.txt").c_str(),"w");
  for(auto [f,l]:SplitIntoBundles(s.frame_count(),o.bundle.frames)){ SegmentedBundle g=SegmentBundle(s,f,l,vol,o);
    printf("bundle %d: %zu -> %zu\n",b,g.difference_set.points.size(),g.points.size());
    auto dump=[&](FILE*H,const ObservedPoints&p,const std::vector<ColourEvidence>*e){for(size_t i=0;i<p.size();++i){Vec3 q=g.T_world_bundle*p.positions[i],r=g.T_world_bundle.linear()*p.viewing_rays[i];fprintf(H,"%.5f %.5f %.5f %.4f %.4f %.4f %g %d %d %d %d\n",q[0],q[1],q[2],r[0],r[1],r[2],p.counts[i],b,e?(*e)[i].edge_pixels:0,e?(*e)[i].outline_pixels:0,e?(*e)[i].outline_edge_pixels:0);}};
    dump(F,g.points,nullptr);dump(G,g.difference_set.points,&g.difference_set.evidence); ++b;}
  fclose(F);fclose(G); printf("segment %.2f s\n",now()-a);
  for(int i: {0,s.frame_count()/3,2*s.frame_count()/3,s.frame_count()-1}){ DepthImage d=LoadDepth(s,i); PinholeCamera sm=s.depth_camera.Scaled(1.0/o.render_divisor); DepthImage r=vol.Raycast(sm,s.frames[i].T_world_camera); DepthImage k=OpenDepth(r,sm,o.opening); MaskImage m=ImageDifferenceSet(d,r,k,o.difference); MaskImage ed=ColourEdges(LoadColor(s,i),o.edges);
    auto vis=[&](const DepthImage&x){cv::Mat g(x.height(),x.width(),CV_8U),q;for(int y=0;y<x.height();++y)for(int u=0;u<x.width();++u)g.at<uchar>(y,u)=std::min(255.f,x(u,y)*140);cv::applyColorMap(g,q,cv::COLORMAP_JET);for(int y=0;y<x.height();++y)for(int u=0;u<x.width();++u)if(x(u,y)<=0)q.at<cv::Vec3b>(y,u)=cv::Vec3b(0,0,0);cv::Mat z;cv::resize(q,z,cv::Size(640,640*x.height()/x.width()),0,0,cv::INTER_NEAREST);return z;};
    cv::Mat D=vis(d),R=vis(r),K=vis(k); cv::Mat M(m.height(),m.width(),CV_8UC3); for(int y=0;y<m.height();++y)for(int u=0;u<m.width();++u){cv::Vec3b p(0,0,0); if(m(u,y))p=cv::Vec3b(255,255,255); if(ed.Contains(u,y)&&ed(u,y))p[2]=255,p[1]/=2; M.at<cv::Vec3b>(y,u)=p;} cv::Mat M2; cv::resize(M,M2,D.size(),0,0,cv::INTER_AREA); cv::Mat t1,t2,t3; cv::hconcat(D,R,t1);cv::hconcat(K,M2,t2);cv::vconcat(t1,t2,t3); cv::imwrite(out+"/f"+std::to_string(i)+".png",t3);}
}
