/* Directives and macros. What they print was printed by povray 3.7.0.10 too, where it is not plain. */
#include "tests/scene_text.h"

/* ---- conditions and loops ---- */

static void one_branch_of_an_if_is_taken(void **state)
{
    (void)state;
    check_prints("#if (1) #debug \"a\" #elseif (1) #debug \"b\" #else #debug \"c\" #end", "a");
    check_prints("#if (0) #debug \"a\" #elseif (1) #debug \"b\" #else #debug \"c\" #end", "b");
    check_prints("#if (0) #debug \"a\" #elseif (0) #debug \"b\" #else #debug \"c\" #end", "c");
    check_prints("#if (0) #if (1) #debug \"a\" #else #debug \"b\" #end #else #debug \"c\" #end", "c");
    check_prints("#if (1) #if (0) #debug \"a\" #else #debug \"b\" #end #else #debug \"c\" #end", "b");
    check_prints("#if (0) \"#end\" /* #end */ // #end\n #debug \"a\" #end #debug \"b\"", "b");
    check_prints("#declare A = 1; #ifdef (A) #debug \"a\" #end #ifndef (A) #debug \"b\" #end #undef A "
                 "#ifdef (A) #debug \"c\" #end #ifndef (A) #debug \"d\" #end", "ad");
}

static void a_directive_may_stand_inside_of_anything(void **state)
{
    (void)state;
    check_prints("#declare A = <1, #if (1) 2 #else 3 #end, 4>; #debug vstr(3, A, \",\", 0, 0)", "1,2,4");
    check_prints("sphere { 0, #local R = 2; R #for (I, 1, 2) translate I*x #end "
                 "pigment { color #if (0) rgb 1 #else rgb 0 #end } }",
                 "");
    check_prints("#declare T = texture { pigment { color rgb 1 } }\n#declare U = texture { T }\n"
                 "sphere { 0, 1 texture { U } }", "");
}

static void cases_fall_through_to_a_break(void **state)
{
    (void)state;
    static const char form[] = "#switch (%d) #case (1) #debug \"a\" "
                 "#case (2) #debug \"b\" #break #range (3, 5) #debug \"c\" "
                               "#break #else #debug \"d\" #end";
    static const struct { int value; const char *expected; } cases[] = { { 1, "ab" }, { 2, "b" }, { 4, "c" }, { 9, "d" } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[256];
        snprintf(text, sizeof text, form, cases[i].value);
        check_prints(text, cases[i].expected);
    }
}

static void loops_run_as_often_as_povrays(void **state)
{
    (void)state;
    check_prints("#for (I, 5, 1, -2) #debug str(I,0,0) #end", "531");
    check_prints("#for (I, 1, 0) #debug \"never\" #end #debug \"end\"", "end");
    check_prints("#declare N = 0; #for (I, 0, 1, .1) #declare N = N + 1; #end #debug str(N,0,0)", "11");
    check_prints("#for (I, 1, 3) #declare I = I + 1; #debug str(I,0,0) #end", "24");
    check_prints("#declare N = 0; #for (I, 1, 3) #for (J, I, 3) #declare N = N+1; #end #end "
                 "#debug concat(str(N,0,0), str(I,0,0))",
                 "64");
    check_prints("#declare N = 3; #while (N > 0) #declare N = N-1; #if (N = 1) #break #end "
                 "#debug str(N,0,0) #end #debug \"end\"",
                 "2end");
    check_prints("#for (I, 1, 2) #switch (I) #case (1) #break #debug \"no\" #end #debug str(I,0,0) #end", "12");
}

/* ---- names ---- */

static void declare_changes_the_nearest_binding(void **state)
{
    (void)state;
    check_prints("#macro M() #local Q = 2; #declare Q = 3; #debug str(Q,0,0) #end "
                 "#declare Q = 1; M() #debug str(Q,0,0)", "31");
    check_prints("#local A = 1; #macro M() #local A = 2; N() #end #macro N() #declare A = A+10; #debug str(A,0,0) #end "
                 "M() #debug str(A,0,0)", "121");
    check_prints("#macro M() #declare New = 7; #end M() #debug str(New,0,0)", "7");
    check_prints("#declare X = 5; #declare X = <1,2,3>; #debug vstr(3,X,\"\",0,0)", "123");
    check_fails("#macro M() #local L = 1; #end M() #debug str(L,0,0)", "unknown identifier 'L'");
    check_fails("#macro M() #for (I, 1, 2) #end #end M() #debug str(I,0,0)", "unknown identifier 'I'");
}

static void lone_identifiers_are_passed_by_reference(void **state)
{
    (void)state;
    check_prints("#macro M(A) #declare A = A+1; #end #declare X = 1; M(X) M(X) #debug str(X,0,0)", "3");
    check_prints("#macro O(V) M(V) #end #macro M(V) #declare V = V*10; #end #declare X = 2; O(X) #debug str(X,0,0)", "20");
    check_prints("#macro M(V) #declare V = V*10; #end #declare X = 2; M(X+0) M((X)) #debug str(X,0,0)", "2");
    check_prints("#macro M(V) #local V = V*10; #end #declare X = 2; M(X) #debug str(X,0,0)", "20");
    check_prints("#declare A = array[3]{1,2,3} #macro M(V) #declare V = V*10; #end M(A[1]) #debug str(A[1],0,0)", "20");
    check_fails("#macro M(V) #declare V = 5; #end M(Q)", "unknown identifier 'Q'");
}

static void a_value_ends_before_what_uses_it(void **state)
{
    (void)state;
    check_prints("#macro M(A) #debug A #end #declare S = \"a\"\nM(S)", "a");
    check_prints("#macro M() texture { T } #end #declare T = texture { pigment { color rgb 1 } }\nsphere { 0, 1 M() }", "");
    check_prints("#if (1) #declare T = texture { pigment { color rgb 1 } } #else #declare T = 1; #end "
                 "sphere { 0, 1 texture { T } }",
                 "");
    check_prints("#macro M() #local T = finish { phong 1 } #end M() "
                 "#ifdef (T) #debug \"yes\" #else #debug \"no\" #end", "no");
}

static void a_macros_body_is_text(void **state)
{
    (void)state;
    check_prints("#macro A(X) X+1 #end #debug str(A(3)*10,0,0)", "13");
    check_prints("#macro A(X) (X+1) #end #debug str(A(A(A(1)))*2,0,0)", "8");
    check_prints("#macro F(N) #if (N<2) 1 #else (N*F(N-1)) #end #end #debug str(F(6),0,0)", "720");
    check_prints("#macro M() #macro K() 7 #end #end M() #debug str(K(),0,0)", "7");
    check_prints("#macro M() #local X = 5; X #end #debug str(M()+M()*2,0,0)", "15");
    check_prints("#macro M(A) #if (A) #debug \"in\" #break #end #debug \"after\" #end M(1) M(0)", "inafter");
    check_prints("#macro Open() sphere { #end #macro Close() } #end Open() 0, 1 Close()", "");
    check_prints("#macro M(A,) #debug \"m\" #end M(1)", "m");
}

/* ---- what is not supported ---- */

static void unsupported_values_are_errors_only_where_they_are_used(void **state)
{
    (void)state;
    static const char declared[] =
        "#declare T = texture { pigment { granite #declare Seen = 1; scale 2 } } texture { pigment { bozo } }\n"
        "#declare F = function(x, y) { x*y }\n#declare N = normal { bumps .5 }\n#declare V = F(1, 2)*3;\n"
        "#declare B = T\n#declare A = array[1]{ texture { T } }\n"
                 "#declare G = trimmed_nurbs < order 2, 2 knots_u { 0, 0, 1, 1 } "
        "knots_v { 0, 0, 1, 1 } points 2, 2 { <0,0,0>, x, y, x+y } pigment { wood } rotate <1,2,3> >\n"
        "#declare L = 1;\n";
    check_prints("#macro M(P) #local R = trace(P); #if (vlength(R)) 1 #else 2 #end #end\n"
                 "#macro P() texture { pigment { wood } } #end\n"
                 "#macro W() #local T = text { ttf \"a\" } (max_extent(T).x) #end #declare W1 = W();\n"
                 "#declare V = <min(trace(1), 2), trace(1).x>;\n#declare A = M(1)\n#if (1) #debug \"a\" #end\n"
                 "#declare B = P()\n#declare C = M(pigment { wood })*2;\n"
                 "#ifdef (A) #ifdef (B) #ifdef (C) #debug \"bc\" #end #end #end", "abc");
    char text[1024];
    snprintf(text, sizeof text, "%s#debug str(L+Seen,0,0)", declared);
    check_prints(text, "2");
    static const struct { const char *use, *expected; } uses[] = {
        { "sphere { 0, 1 texture { T } }", "'T' uses 'granite'" }, { "#debug str(F(1,2),0,0)", "'F' uses 'function'" },
        { "#debug str(V,0,0)", "'V' uses 'function'" }, { "sphere { 0, 1 texture { B } }", "'B' uses 'granite'" },
        { "sphere { 0, 1 texture { A[0] } }", "'A' uses 'granite'" },
        { "sphere { 0, 1 normal { N } }", "'normal' is a POV-Ray feature that is not supported here" },
        { "object { G }", "'G' uses 'wood'" },
    };
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        snprintf(text, sizeof text, "%s%s", declared, uses[i].use);
        check_fails(text, uses[i].expected);
    }
}

/* Those that declare what is not supported are read all the same. */
static void the_standard_include_files_load(void **state)
{
    (void)state;
    static const char *const names[] = {
        "colors", "textures", "metals", "glass", "golds", "shapes", "math", "transforms", "rand", "functions", "consts",
        "finish", "strings", "arrays", "skies", "stones", "woods", "chars", "ior", "shapes2", "shapes3", "shapesq", "logo",
        "stars", "screen", "debug", "meshmaker", "rad_def", "sunpos", "stdinc", "stdcam",
    };
    if (access("/usr/share/povray-3.7/include/colors.inc", R_OK) != 0) skip();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[256];
        snprintf(text, sizeof text, "#version 3.7; global_settings { assumed_gamma 1 } "
                 "#include \"colors.inc\" #include \"shapes.inc\" "
                 "#include \"%s.inc\" #debug \"read\"", names[i]);
        check_prints(text, "read");
    }
}

/* ---- limits ---- */

static void endless_scenes_end(void **state)
{
    (void)state;
    static const struct { const char *text, *expected; } cases[] = {
        { "#while (1) #end", "more than 1000 rounds of loops and calls of macros" },
        { "#macro M() #end #for (I, 1, 1e9) M() #end", "more than 1000 rounds of loops and calls of macros" },
        { "#macro M() M() #end M()", "macros and include files are nested more than 100 deep" },
        { "#macro M(A) M(M(A)) #end M(1)", "nested more than" },
        { "#declare S = \"ab\"; #while (1) #declare S = concat(S, S); #end", "this string grows too long" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Read r = read_bytes(cases[i].text, strlen(cases[i].text), (ParseOptions){ .max_steps = 1000 });
        CHECK(strstr(r.messages, cases[i].expected), "%s: %s", cases[i].text, r.messages);
        read_done(&r);
    }
}

static void at_most_20_errors_are_told(void **state)
{
    (void)state;
    char text[2048] = "";
    for (int i = 0; i < 50; i++) strcat(text, "sphre { 0, 1 }\n");
    Read r = read_scene_text(text);
    CHECK(r.n_errors == 20, "%d errors", r.n_errors);
    read_done(&r);
    r = read_scene_text("#for (I, 1, 30) sphre { 0, 1 } #end");
    CHECK(r.n_errors == 1, "%d errors of one place", r.n_errors);
    read_done(&r);
}

static void the_statements_after_an_error_are_read(void **state)
{
    (void)state;
    static const struct { const char *text; int n_errors; size_t n_objects; } cases[] = {
        { "sphere { 0, } sphere { 0, 1 }", 1, 1 },
        { "box { 0, 1\nsphere { 0, 1 }\nsphere { 0, 1 }", 1, 2 },
        { "union { sphere { 0, } sphere { 0, 1 } } sphere { 0, 1 }", 1, 1 },
        { "#declare A = 1 + ; sphere { 0, 1 }", 1, 1 },
        { "#declare A =\n#declare B = 1;\nsphere { 0, B }", 1, 1 },
        { "#include \"nosuch\" sphere { 0, 1 }\nsphere { 0, 1 }", 1, 2 },
        { "#if (1 + ) sphere { 0, 1 } #else sphere { 0, 1 } #end sphere { 0, 1 }", 1, 1 },
        { "#if (1) sphere { 0, } #else sphere { 0, 1 } #end sphere { 0, 1 }", 1, 1 },
        { "#macro M(A) sphere { A, } sphere { 0, 1 } #end M(1) M(0) sphere { 0, 1 }", 1, 3 },
        { "#macro M(A) #end M(1, 2) sphere { 0, 1 }", 1, 1 },
        { "trimmed_nurbs < order 2, 2 knots_u { 0, \"a\" } rotate <1,2,3> > sphere { 0, 1 }", 1, 1 },
        { "sphere { 0, 1 }; sphere { 0, 1 }", 1, 2 },
        { "} sphere { 0, 1 }", 1, 1 },
        { "union {\nsphere { 0, }\nsphere { 0, 1 }\n}\nsphere { 0, 1 }", 1, 1 },
        { "#macro M(A, B) #end M(function(x) { x }, 1) sphere { 0, 1 }", 1, 1 },
        { "#declare T = texture { pigment { color rgb 1 } }\nunion { sphere { 0, } } sphere { 0, 1 }", 1, 1 },
        { "sphere { 0, \"a\nsphere { 0, 1 }", 1, 0 },
        { "#end sphere { 0, 1 }\nsphere { 0, 1 }", 1, 2 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Read r = read_scene_text(cases[i].text);
        CHECK(r.n_errors == cases[i].n_errors, "%s\n%s", cases[i].text, r.messages);
        CHECK(r.scene->n_objects == cases[i].n_objects, "%s: %zu objects", cases[i].text, r.scene->n_objects);
        read_done(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_branch_of_an_if_is_taken),
        cmocka_unit_test(a_directive_may_stand_inside_of_anything),
        cmocka_unit_test(cases_fall_through_to_a_break),
        cmocka_unit_test(loops_run_as_often_as_povrays),
        cmocka_unit_test(declare_changes_the_nearest_binding),
        cmocka_unit_test(lone_identifiers_are_passed_by_reference),
        cmocka_unit_test(a_value_ends_before_what_uses_it),
        cmocka_unit_test(a_macros_body_is_text),
        cmocka_unit_test(unsupported_values_are_errors_only_where_they_are_used),
        cmocka_unit_test(the_standard_include_files_load),
        cmocka_unit_test(endless_scenes_end),
        cmocka_unit_test(at_most_20_errors_are_told),
        cmocka_unit_test(the_statements_after_an_error_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
