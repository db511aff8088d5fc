/* The reserved words of POV-Ray 3.7, in two lists: those that the parse rules know, and the rest, so that a feature which is
 * missing is named and not "unknown". Objects need not be moved from one to the other: parse_object_words() tells. */
#include "parser/keywords.h"
#include "parser/functions.h"

#include <string.h>

/* Words of the rule files. */
static const char supported[] =
    "adaptive adc_bailout albedo all ambient ambient_light angle area_illumination area_light array assumed_gamma "
    "bounded_by boxed brick brick_size brilliance caustics charset checker circular clipped_by color_map colour_map "
    "conserve_energy cubic_wave cylindrical diffuse direction distance double_illuminate emission exponent face_indices "
    "fade_color fade_colour fade_distance fade_power falloff finish flatness fog_alt fog_offset fog_type frequency "
    "fresnel gamma gradient gray hexagon hf_gray_16 hierarchy hollow image_map inside_vector interior interior_texture "
    "interpolate inverse ior irid_wavelength jitter leopard location look_at map_type matrix max_intersections "
    "max_trace_level media_attenuation media_interaction metallic mm_per_unit mortar no_image no_radiosity "
    "no_reflection no_shadow noise_generator normal_indices normal_vectors number_of_waves once onion open orient "
    "orthographic parallel perspective phase phong phong_size photons pigment pigment_map planar png point_at poly_wave "
    "quick_color quick_colour radial radiosity radius ramp_wave reflection reflection_exponent right rotate roughness "
    "scale scallop_wave shadowless sine_wave sky specular spherical spotlight sturm texture texture_list tightness "
    "transform translate triangle_wave type u_steps up uv_indices uv_mapping uv_vectors v_steps vertex_vectors "
    "break case debug declare default else elseif end error for if ifdef ifndef include local macro range render "
    "statistics switch undef warning while";

/* Words that are known where they are looked for, and free everywhere else: not POV-Ray's. */
static const char contextual[] =
    "curvature curve degree flattening keep knots knots_u knots_v left max_iterations method mixed nurbs order paper "
    "points trim trimmed_nurbs";

static const char unsupported[] =
    "aa_level aa_threshold absorption accuracy agate agate_turb all_intersections alpha altitude always_sample aperture "
    "append arc_angle ascii autostop average b_spline bezier_spline bicubic_patch black_hole blob blur_samples box bozo "
    "brightness bump_map bump_size bumps cells collect component composite cone confidence conic_sweep contained_by "
    "control0 control1 coords count crackle crand cube cubic cubic_spline cutaway_textures cylinder datetime density "
    "density_file density_map dents df3 difference disc dispersion dispersion_samples dist_exp eccentricity error_bound "
    "evaluate expand_thresholds exr exterior extinction facets falloff_angle fclose fisheye flip focal_point fopen form "
    "function gather gif global_lights granite gray_threshold hdr height_field hypercomplex image_pattern initial "
    "inside internal intersection intervals irid isosurface jpeg julia julia_fractal lambda lathe light_group "
    "linear_spline linear_sweep load_file looks_like low_error_factor magnet major_radius mandel marble material_map "
    "max_extent max_gradient max_iteration max_sample max_trace maximum_reuse media merge mesh mesh2 mesh_camera metric "
    "min_extent minimum_reuse natural_spline nearest_count no_bump_scale normal normal_map now number_of_sides "
    "number_of_tiles octaves offset omega omnimax orientation panoramic parametric pass_through pattern pavement pgm "
    "pigment_pattern poly polygon polynomial pot ppm precision precompute premultiplied pretrace_end pretrace_start "
    "prism prod projected_through pwr quadratic_spline quadric quartic quaternion quilted rainbow ratio read reciprocal "
    "recursion_limit refraction repeat ripples samples save_file scattering size slice slope slope_map smooth solid sor "
    "spacing sphere_sweep spiral1 spiral2 spline split_union spotted sqr strength subsurface sum superellipsoid sys "
    "target text tga thickness threshold tiff tile2 tiles tiling tolerance toroidal torus trace translucency ttf "
    "turb_depth turbulence ultra_wide_angle use_alpha use_color use_colour use_index utf8 variance vturbulence warp "
    "water_level waves width wood wrinkles write";

static void mark_list(Symbols *s, const char *list, WordClass class)
{
    while (*list) {
        size_t n = strcspn(list, " ");
        symbols_intern(s, list, n)->class = class;
        list += n + (list[n] == ' ');
    }
}

void keywords_mark(Symbols *s)
{
    const char *const *object = parse_object_words();
    mark_list(s, unsupported, WORD_UNSUPPORTED);
    mark_list(s, supported, WORD_SUPPORTED);
    for (; *object; object++) symbols_intern(s, *object, strlen(*object))->class = WORD_SUPPORTED;
    mark_list(s, contextual, WORD_CONTEXTUAL);
    for (size_t i = 0; builtin_at(i); i++) {
        const Builtin *b = builtin_at(i);
        symbols_intern(s, b->name, strlen(b->name))->builtin = b;
    }
}
