#include "fusion/depth_opening.h"
#include <opencv2/imgproc.hpp>
#include <cmath>
namespace curvefusion {
void VisitOptions(DepthOpeningOptions& o, OptionVisitor& v){ v.Visit({"opening_radius","m",0,1,"x"},o.radius);}
DepthImage OpenDepth(const DepthImage& z, const PinholeCamera& c, const DepthOpeningOptions& o){
  const int w=z.width(),h=z.height(); cv::Mat edge(h,w,CV_8U,cv::Scalar(255));
  for(int v=0;v<h;++v)for(int u=0;u<w;++u){ float a=z(u,v); if(a<=0){continue;}
    const int D[4][2]={{1,0},{-1,0},{0,1},{0,-1}}; for(auto&d:D){int x=u+d[0],y=v+d[1]; if(!z.Contains(x,y))continue; float b=z(x,y); 
      float tol=std::max<float>(o.discontinuity, 0.03f*a); // slope-tolerant
      int x2=u-d[0],y2=v-d[1]; float ext=a; if(z.Contains(x2,y2)&&z(x2,y2)>0&&std::abs(z(x2,y2)-a)<0.2f*a) ext=2*a-z(x2,y2);
      if(b<=0){ edge.at<uint8_t>(v,u)=0; } else if(b-a>tol && b-ext>tol) edge.at<uint8_t>(v,u)=0; } }
  cv::Mat dt; cv::distanceTransform(edge,dt,cv::DIST_L2,5);
  cv::Mat surv(h,w,CV_8U,cv::Scalar(255));
  for(int v=0;v<h;++v)for(int u=0;u<w;++u){ float a=z(u,v); if(a>0 && dt.at<float>(v,u)+0.5f>=c.fx*o.radius/a) surv.at<uint8_t>(v,u)=0; }
  cv::Mat dt2,lab; cv::distanceTransform(surv,dt2,lab,cv::DIST_L2,5,cv::DIST_LABEL_PIXEL);
  std::vector<float> ld; { double mx; cv::minMaxLoc(lab,nullptr,&mx); ld.assign((size_t)mx+1,0); for(int v=0;v<h;++v)for(int u=0;u<w;++u) if(!surv.at<uint8_t>(v,u)) ld[lab.at<int>(v,u)]=z(u,v);}
  DepthImage k(w,h,0);
  for(int v=0;v<h;++v)for(int u=0;u<w;++u){ float a=z(u,v); if(a<=0)continue; float r=c.fx*o.radius/a; if(dt2.at<float>(v,u)<=r+0.5f){ float b=ld[lab.at<int>(v,u)]; if(b>0&&std::abs(b-a)<0.05f+0.1f*a) k(u,v)=a; } }
  return k; }
}
