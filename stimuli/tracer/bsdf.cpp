#include "stimuli/tracer/bsdf.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace plenolab::tracer {

namespace {

using Kind = Material::Kind;

constexpr Rgb kDefaultAlbedo{0.5f, 0.5f, 0.5f};
constexpr float kDefaultRoughness = 0.2f;
// Below this α the GGX peak exceeds what single precision resolves; ideal reflection is Kind::kMirror.
constexpr float kMinAlpha = 1e-3f;
constexpr float kRounding = 1e-4f;  // textures may leave their range by this much

float checked(float value, const char* what) {
  if (!(value >= -kRounding && value <= 1 + kRounding))
    throw InputError(
        fmt::format("a texture of the scene returned the {} {}; it must lie in [0, 1]", what, value));
  return std::clamp(value, 0.0f, 1.0f);
}

Rgb albedo_at(const Material& material, const SurfacePoint& point) {
  const Rgb c = material.albedo ? material.albedo(point) : kDefaultAlbedo;
  return {checked(c.r, "albedo"), checked(c.g, "albedo"), checked(c.b, "albedo")};
}

Vec3 texture_normal(const Material& material, const SurfacePoint& point, const Vec3& geometric_normal) {
  if (!material.normal) return point.normal;
  const Vec3 n = material.normal(point);
  const float length = n.norm();
  if (!(length > 0) || !std::isfinite(length))
    throw InputError("a normal texture of the scene returned a vector without length or that is not finite");
  return n.dot(geometric_normal) < 0 ? Vec3(-n / length) : Vec3(n / length);
}

// Bends a shading normal until the mirror direction leaves the geometric surface: bumps would otherwise
// reflect rays into the ground and leave black spots at grazing angles.
Vec3 bent_normal(const Vec3& normal, const Vec3& geometric_normal, const Vec3& outgoing) {
  const float lowest = std::min(0.01f, 0.9f * outgoing.dot(geometric_normal));
  const Vec3 mirror = reflected(outgoing, normal);
  const float height = mirror.dot(geometric_normal);
  if (height >= lowest && outgoing.dot(normal) > 0) return normal;
  const Vec3 lifted = (mirror + (lowest - height) * geometric_normal).normalized();
  const Vec3 half = outgoing + lifted;
  const float length = half.norm();
  return length > 1e-4f ? Vec3(half / length) : geometric_normal;
}

float ggx_d(float cos_h, float alpha) {
  const float a2 = alpha * alpha;
  const float k = 1.0f + (a2 - 1.0f) * cos_h * cos_h;
  return a2 / (kPi * k * k);
}

// Λ of Smith's masking function for GGX (Heitz 2014, equation 72).
float ggx_lambda(float cosine, float alpha) {
  const float cos2 = cosine * cosine;
  const float tan2 = std::max(0.0f, 1.0f - cos2) / cos2;
  return 0.5f * (std::sqrt(1.0f + alpha * alpha * tan2) - 1.0f);
}

// Visible normal in the local frame (Heitz 2018, "Sampling the GGX distribution of visible normals").
Vec3 sample_visible_normal(const Vec3& v, float alpha, std::array<float, 2> u) {
  const Vec3 stretched = Vec3(alpha * v.x(), alpha * v.y(), v.z()).normalized();
  const float length2 = square(stretched.x()) + square(stretched.y());
  const Vec3 t1 =
      length2 > 0 ? Vec3(Vec3(-stretched.y(), stretched.x(), 0) / std::sqrt(length2)) : Vec3(1, 0, 0);
  const Vec3 t2 = stretched.cross(t1);
  const float radius = std::sqrt(u[0]), phi = 2.0f * kPi * u[1];
  const float a = radius * std::cos(phi);
  const float s = 0.5f * (1.0f + stretched.z());
  const float b = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - a * a)) + s * radius * std::sin(phi);
  const float c = std::sqrt(std::max(0.0f, 1.0f - a * a - b * b));
  const Vec3 n = a * t1 + b * t2 + c * stretched;
  return Vec3(alpha * n.x(), alpha * n.y(), std::max(0.0f, n.z())).normalized();
}

Vec3 cosine_direction(const Vec3& normal, std::array<float, 2> u) {
  const float radius = std::sqrt(u[0]), phi = 2.0f * kPi * u[1];
  const Vec3 local(radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0f, 1.0f - u[0])));
  return Frame(normal).to_world(local).normalized();
}

// Share of samples given to the GGX lobe of a glossy surface. Bounds keep the mixture density from vanishing
// where one lobe dominates unexpectedly.
float reflection_share(const Surface& s) {
  if (s.material->kind == Kind::kMetal) return 1.0f;
  const float base = max_component(s.albedo);
  if (base == 0) return 1.0f;
  const float f = fresnel_dielectric(s.outgoing.dot(s.normal), s.material->ior);
  return std::clamp(f / (f + (1.0f - f) * base), 0.1f, 0.9f);
}

Rgb schlick(Rgb f0, float cosine) {
  const float k = std::pow(std::max(0.0f, 1.0f - cosine), 5.0f);
  return f0 + (Rgb{1, 1, 1} - f0) * k;
}

BsdfValue evaluate_ggx(const Surface& s, const Vec3& incoming, float cos_i, float cos_o) {
  const Vec3 half = (incoming + s.outgoing).normalized();
  const float cos_h = std::min(1.0f, half.dot(s.normal));
  const float cos_d = std::clamp(half.dot(s.outgoing), 0.0f, 1.0f);
  const float d = ggx_d(cos_h, s.alpha);
  const float lambda_o = ggx_lambda(cos_o, s.alpha), lambda_i = ggx_lambda(cos_i, s.alpha);
  const Rgb f = s.material->kind == Kind::kMetal ? schlick(s.albedo, cos_d)
                                                 : Rgb{1, 1, 1} * fresnel_dielectric(cos_d, s.material->ior);
  const float over = d / (4.0f * cos_o);
  return {f * (over / (1.0f + lambda_o + lambda_i)), over / (1.0f + lambda_o)};
}

std::optional<BsdfSample> sample_dielectric(const Surface& s, float lobe) {
  const float eta = s.front ? s.material->ior : 1.0f / s.material->ior;
  const float cos_i = std::clamp(s.outgoing.dot(s.normal), 0.0f, 1.0f);
  if (lobe < fresnel_dielectric(cos_i, eta)) {
    const Vec3 mirror = reflected(s.outgoing, s.normal);
    if (mirror.dot(s.geometric_normal) <= 0) return std::nullopt;
    return BsdfSample{mirror.normalized(), {1, 1, 1}, 1.0f, false};
  }
  const float cos_t2 = 1.0f - (1.0f - cos_i * cos_i) / (eta * eta);
  if (cos_t2 <= 0) return std::nullopt;
  const Vec3 refracted = -s.outgoing / eta + (cos_i / eta - std::sqrt(cos_t2)) * s.normal;
  if (refracted.dot(s.geometric_normal) >= 0) return std::nullopt;
  const float scale = 1.0f / (eta * eta);
  return BsdfSample{refracted.normalized(), {scale, scale, scale}, 1.0f, true};
}

Vec3 sample_direction(const Surface& s, float lobe, std::array<float, 2> u) {
  if (s.material->kind == Kind::kDiffuse || lobe >= reflection_share(s)) return cosine_direction(s.normal, u);
  const Frame frame(s.normal);
  const Vec3 half = frame.to_world(sample_visible_normal(frame.to_local(s.outgoing), s.alpha, u));
  return reflected(s.outgoing, half).normalized();
}

}  // namespace

float fresnel_dielectric(float cos_i, float eta) {
  const float cos_t2 = 1.0f - (1.0f - cos_i * cos_i) / (eta * eta);
  if (cos_t2 <= 0) return 1.0f;
  const float cos_t = std::sqrt(cos_t2);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

Surface make_surface(const Hit& hit, const Vec3& ray_direction) {
  const Material& material = *hit.material;
  Surface s;
  s.material = &material;
  s.position_m = hit.point.position_m;
  s.outgoing = -ray_direction;
  s.geometric_normal = hit.geometric_normal;
  s.front = hit.front;
  s.normal = texture_normal(material, hit.point, hit.geometric_normal);
  if (material.kind != Kind::kDielectric) s.albedo = albedo_at(material, hit.point);
  if (material.kind == Kind::kDiffuse) return s;
  s.normal = bent_normal(s.normal, s.geometric_normal, s.outgoing);
  if (material.kind == Kind::kGlossy || material.kind == Kind::kMetal) {
    const float roughness = material.roughness ? material.roughness(hit.point) : kDefaultRoughness;
    s.alpha = std::max(kMinAlpha, checked(roughness, "roughness"));
  }
  return s;
}

BsdfValue evaluate_bsdf(const Surface& s, const Vec3& incoming) {
  const float cos_i = incoming.dot(s.normal);
  if (cos_i <= 0 || incoming.dot(s.geometric_normal) <= 0) return {};
  if (s.material->kind == Kind::kDiffuse) return {s.albedo * (cos_i / kPi), cos_i / kPi};
  const float cos_o = s.outgoing.dot(s.normal);
  if (cos_o <= 0) return {};
  BsdfValue value = evaluate_ggx(s, incoming, cos_i, cos_o);
  if (s.material->kind == Kind::kMetal) return value;
  const float share = reflection_share(s);
  const float passes = (1.0f - fresnel_dielectric(cos_i, s.material->ior)) *
                       (1.0f - fresnel_dielectric(std::min(1.0f, cos_o), s.material->ior));
  value.f_cos += s.albedo * (passes * cos_i / kPi);
  value.pdf = share * value.pdf + (1.0f - share) * cos_i / kPi;
  return value;
}

std::optional<BsdfSample> sample_bsdf(const Surface& s, float lobe, std::array<float, 2> u) {
  if (s.material->kind == Kind::kDielectric) return sample_dielectric(s, lobe);
  if (s.material->kind == Kind::kMirror)
    return BsdfSample{reflected(s.outgoing, s.normal).normalized(), s.albedo, 1.0f, false};
  const Vec3 incoming = sample_direction(s, lobe, u);
  const BsdfValue value = evaluate_bsdf(s, incoming);
  if (!(value.pdf > 0)) return std::nullopt;
  return BsdfSample{incoming, value.f_cos * (1.0f / value.pdf), value.pdf, false};
}

}  // namespace plenolab::tracer
