/* Expressions. The truth is computed by hand, or was printed by povray 3.7.0.10 (the tables that say so). */
#include "tests/scene_text.h"

typedef struct { const char *expression, *expected; } Case;

#define COUNT(list) (sizeof (list) / sizeof *(list))

/* Each expression is printed by str(..., 0, 6). */
static void check_floats(const Case cases[], size_t n)
{
    for (size_t i = 0; i < n; i++) {
        char text[512];
        snprintf(text, sizeof text, "#debug str(%s, 0, 6)", cases[i].expression);
        check_prints(text, cases[i].expected);
    }
}

static void operators_bind_as_by_hand(void **state)
{
    (void)state;
    static const Case cases[] = {
        { "2+3*4", "14.000000" }, { "(2+3)*4", "20.000000" }, { "2*3+4/2-1", "7.000000" }, { "10-4-3", "3.000000" },
        { "24/4/2", "3.000000" }, { "-2*-3+4*2", "14.000000" }, { "- -2", "2.000000" }, { "2*-3", "-6.000000" },
        { "!0", "1.000000" }, { "!3+1", "1.000000" }, { "(1+2<2+2)", "1.000000" }, { "(1 < 2 ? 3 : 4) + 1", "4.000000" },
        { "(0 ? 1 : 0 ? 2 : 3)", "3.000000" }, { "((1 = 1) & (2 != 3))", "1.000000" },
    };
    check_floats(cases, COUNT(cases));
}

static void operators_do_what_povray_prints(void **state)
{
    (void)state;
    static const Case cases[] = {
        { "(1|0&0)", "0.000000" }, { "(1&0|1)", "1.000000" }, { "(0=0&1)", "1.000000" }, { "(-1<0)*3", "3.000000" },
        { "(3>2>1)", "0.000000" }, { "(1=1=1)", "1.000000" }, { "(1=1.00000000001)", "1.000000" },
        { "(1<=.999999999999)", "1.000000" }, { "(1>=1.000000000001)", "1.000000" }, { "(1<1.000000000001)", "1.000000" },
        { "!1e-11", "1.000000" }, { "1/0", "inf" }, { "-1/0", "inf" }, { "(\"abc\"<\"abd\")", "1.000000" },
        { "(<1,2,3>+1).z", "4.000000" }, { "x.x", "1.000000" }, { "<1,2,3>.x*2", "2.000000" },
    };
    check_floats(cases, COUNT(cases));
}

static void functions_give_what_povray_prints(void **state)
{
    (void)state;
    static const Case cases[] = {
        { "int(-2.7)", "-2.000000" }, { "div(-7,2)", "-3.000000" }, { "mod(-7,3)", "-1.000000" },
        { "ceil(-1.5)", "-1.000000" }, { "floor(-1.5)", "-2.000000" }, { "min(3,1,2)", "1.000000" },
        { "max(1,<2,3>.y,2)", "3.000000" }, { "select(-1,2,3)", "2.000000" }, { "select(0,2,3)", "3.000000" },
        { "select(5,2,3)", "3.000000" }, { "select(5,2,3,4)", "4.000000" }, { "atan2(1,-1)", "2.356194" },
        { "log(100)", "2.000000" }, { "ln(10)", "2.302585" }, { "acosh(2)", "1.316958" }, { "atanh(.5)", "0.549306" },
        { "degrees(pi)", "180.000000" }, { "radians(180)", "3.141593" }, { "bitwise_and(6,3)", "2.000000" },
        { "bitwise_xor(6,3)", "5.000000" }, { "vlength(<3,4>)", "5.000000" }, { "vdot(<1,2>,<3,4>)", "11.000000" },
        { "strcmp(\"a\",\"b\")", "-1.000000" }, { "strlen(\"a\\n\")", "2.000000" }, { "strlen(\"\\\\\")", "1.000000" },
        { "asc(\"a\")", "97.000000" }, { "val(\"12.5abc\")", "12.500000" }, { "defined(Foo)", "0.000000" },
        { "exp(1000)", "inf" }, { "asin(2)", "1.570796" }, { "version", "3.700000" }, { "on+yes+true", "3.000000" },
        { "off+no+false", "0.000000" }, { "file_exists(\"/nosuch\")", "0.000000" },
    };
    check_floats(cases, COUNT(cases));
}

static void vectors_are_what_povray_prints(void **state)
{
    (void)state;
    static const Case cases[] = {
        { "vstr(5, <1,2,3,4,5>*2, \",\", 0, 0)", "2,4,6,8,10" }, { "vstr(3, <1,2>+<1,1,1>, \",\", 0, 0)", "2,3,1" },
        { "vstr(4, <1,2,3,4>+5, \",\", 0, 0)", "6,7,8,9" }, { "vstr(3, <1 2 3>, \",\", 0, 0)", "1,2,3" },
        { "vstr(2, <1 -2, 3>, \",\", 0, 0)", "-1,3" }, { "vstr(3, (<1,2,3> < <2,1,4>), \",\", 0, 0)", "1,0,1" },
        { "vstr(3, <1,2,3>/2*2-1, \",\", 0, 0)", "0,1,2" }, { "vstr(4, t, \",\", 0, 0)", "0,0,0,1" },
        { "vstr(2, u, \",\", 0, 0)", "1,0" },
        { "vstr(3, vrotate(<1,2,3>,<10,20,30>), \",\", 0, 9)", "1.067425379,2.289059483,2.760581414" },
        { "vstr(3, vaxis_rotate(<1,2,3>,<1,1,2>,33), \",\", 0, 9)", "0.858316761,1.696987329,3.222347955" },
        { "vstr(3, vcross(<1,2,3>,<1,1,2>), \",\", 0, 0)", "1,1,-1" },
        { "vstr(3, vnormalize(<3,4>), \",\", 0, 3)", "0.600,0.800,0.000" },
        { "vstr(3, vnormalize(0), \",\", 0, 0)", "0,0,0" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char text[512];
        snprintf(text, sizeof text, "#debug %s", cases[i].expression);
        check_prints(text, cases[i].expected);
    }
}

static void colours_are_what_povray_prints(void **state)
{
    (void)state;
    static const Case cases[] = {
        { "rgb <1,.5,.25> filter .5", "1.000,0.500,0.250,0.500,0.000" }, { "rgb .5", "0.500,0.500,0.500,0.000,0.000" },
        { "color 1", "1.000,1.000,1.000,1.000,1.000" }, { "color <1,2,3>", "1.000,2.000,3.000,0.000,0.000" },
        { "rgbf <1,.5>", "1.000,0.500,0.000,0.000,0.000" }, { "rgbt 1", "1.000,1.000,1.000,0.000,1.000" },
        { "rgb x*.5+y", "0.500,1.000,0.000,0.000,0.000" }, { "red 1 blue .5", "1.000,0.000,0.500,0.000,0.000" },
        { "rgbt G", "0.200,0.400,0.600,0.000,0.100" }, { "color G transmit .3", "0.200,0.400,0.600,0.100,0.300" },
        { "G*2+.1", "0.500,0.900,1.300,0.300,0.500" }, { "G*<.5,.25,1>", "0.100,0.100,0.600,0.000,0.000" },
        { "rgb <1,.5,.25,.5>", "1.000,0.500,0.250,0.500,0.000" },
        { "srgb <.5,.25,.02>*2", "1.000,0.214,0.003,0.000,0.000" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char text[512];
        snprintf(text, sizeof text, "global_settings { assumed_gamma 1 } #declare G = rgbft <.2,.4,.6,.1,.2>; "
                 "#declare C = %s; "
                 "#debug vstr(5, C, \",\", 0, 3)", cases[i].expression);
        check_prints(text, cases[i].expected);
    }
    check_prints("#declare C = rgb .1; #debug str(C.red, 0, 12)", "0.100000001490");   /* single precision */
    check_prints("#declare C = rgb <.2,.4,.6>; #debug str(C.gray, 0, 6)", "0.363400");
}

static void random_streams_are_povrays(void **state)
{
    (void)state;
    check_prints("#declare S = seed(42); #for (I, 1, 3) #debug concat(str(rand(S), 0, 9), \" \") #end",
                 "0.723582911 0.329979260 0.755761670 ");
    check_prints("#declare S = seed(-5); #debug str(rand(S), 0, 9)", "0.890052870");
    check_prints("#declare S = seed(1e10); #debug str(rand(S), 0, 9)", "0.500002874");
    check_prints("#declare S = seed(3.99); #debug str(rand(S), 0, 9)", "0.265972877");
}

static void strings_are_made_as_povray_makes_them(void **state)
{
    (void)state;
    static const Case cases[] = {
        { "concat(\"a\", str(1,0,0), chr(66))", "a1B" }, { "str(5,-8,2)", "00005.00" }, { "str(5,8,2)", "    5.00" },
        { "str(1/3,0,-1)", "0.333333" }, { "str(-5,-8,2)", "-0005.00" }, { "strupr(\"aBc\")", "ABC" },
        { "strlwr(\"aBc\")", "abc" }, { "substr(\"hello\",2,3)", "ell" }, { "vstr(2,<1,2>,\"-\",5,1)", "  1.0-  2.0" },
        { "\"two\nlines\"", "two\nlines" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char text[512];
        snprintf(text, sizeof text, "#declare S = %s; #debug S", cases[i].expression);
        check_prints(text, cases[i].expected);
    }
}

static void arrays_keep_their_elements(void **state)
{
    (void)state;
    check_prints("#declare A = array[2][3]{{1,2,3},{4,5,6}} #debug concat(str(A[1][2.9],0,0), str(dimension_size(A,2),0,0))",
                 "63");
    check_prints("#declare A = array[2]{1,2} #declare B = A; #declare B[0] = 7; #debug str(A[0],0,0)", "1");
    check_prints("#declare A = array[2]{<1,2,3>,<4,5,6>} #debug concat(str(A[1].y,0,0), str(dimensions(A),0,0))", "51");
    check_prints("#declare A = array mixed [2]{\"s\", array[2]{3,4}} #debug concat(A[0], str(A[1][1],0,0))", "s4");
    check_prints("#declare A = array[2]; #ifdef (A[0]) #debug \"yes\" #else #debug \"no\" #end", "no");
    check_prints("#declare A = array[2]{sphere{0,1}, box{0,1}} object { A[1] }", "");
}

static void wrong_expressions_are_told_from_each_other(void **state)
{
    (void)state;
    static const Case cases[] = {
        { "#debug str(sqrt(-1),0,0)", "error: sqrt is not defined for these numbers" },
        { "#debug str(pow(0,0),0,0)", "error: pow is not defined for these numbers" },
        { "#declare A = rgb x + rgb y;", "error: expected an expression, found 'rgb'" },
        { "#declare A = 1 < 2;", "error: expected ';' after the value of 'A', found '<'" },
        { "#declare A = 1 ? 2 : 3;", "error: expected ';' after the value of 'A', found '?'" },
        { "#declare V = <1,2>; #debug str(V.z,0,0)", "error: there is no component 'z' in a vector of 2 components" },
        { "#debug str(5)", "error: expected an expression, found ')'" },
        { "#debug str(rand(5),0,0)", "error: rand wants what seed() gave" },
        { "#declare A = <1>;", "error: a vector has 2 to 5 components" },
        { "#declare A = <1,2,3,4,5,6>;", "error: expected '>' to close the vector (line 1), found '6'" },
        { "#declare A = \"a\" + 1;", "error: a string and a float cannot be operands here" },
        { "#declare A = 1 + \"a\";", "error: a float and a string cannot be operands here" },
        { "#declare A = array[2]{1}", "error: expected an element of the array, found '}'" },
        { "#declare A = array[2]{1,2} #debug str(A[2],0,0)", "error: subscript 2: this array has elements 0 to 1" },
        { "#declare A = array[2]; #debug str(A[1],0,0)", "error: this element of 'A' has been given no value" },
        { "#declare A = array[100000][100000];", "error: an array of 1e+10 elements is too large" },
        { "#declare A = srgb 1;", "error: srgb colours cannot be read before assumed_gamma is set" },
        { "sphere { <1,2,3,4>, 1 }", "error: expected a vector of 3 components, found one of 4" },
        { "sphere { 0, x }", "error: expected a float, found a vector" },
        { "sphere { 0, 1 pigment { color x*\"a\" } }", "error: a vector and a string cannot be operands here" },
        { "sphere { 0, 1 pigment { <1,2,3> } }", "error: expected a colour, found a vector" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) check_fails(cases[i].expression, cases[i].expected);
}

static void nesting_is_limited(void **state)
{
    (void)state;
    char text[4096] = "#declare A = ";
    memset(text + strlen(text), '(', 2000);
    check_fails(text, "error: this is nested more than 200 deep");
    snprintf(text, sizeof text, "#declare A = ");
    memset(text + strlen(text), '-', 2000);
    check_fails(text, "error: this is nested more than 200 deep");
    snprintf(text, sizeof text, "#declare A = ");
    for (int i = 0; i < 500; i++) strcat(text, "A(");
    check_fails(text, "error: unknown identifier 'A'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operators_bind_as_by_hand),
        cmocka_unit_test(operators_do_what_povray_prints),
        cmocka_unit_test(functions_give_what_povray_prints),
        cmocka_unit_test(vectors_are_what_povray_prints),
        cmocka_unit_test(colours_are_what_povray_prints),
        cmocka_unit_test(random_streams_are_povrays),
        cmocka_unit_test(strings_are_made_as_povray_makes_them),
        cmocka_unit_test(arrays_keep_their_elements),
        cmocka_unit_test(wrong_expressions_are_told_from_each_other),
        cmocka_unit_test(nesting_is_limited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
