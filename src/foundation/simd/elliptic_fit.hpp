#pragma once

// Made by tests/reference/fit_elliptic.py, which says what these are; remake, do not edit.
// clang-format off

namespace slipfront::pulse::fit {

/// The largest s = sqrt(m1) that these hold for.
inline constexpr double largest_s = 0.9;

/// Relative error 1.1e-17, before rounding; this part and
inline constexpr double K[] = {
    1.3862943611198906,
    9.6573590287339156e-2,
    3.0885156801235702e-2,
    1.4939859321527618e-2,
    8.8628759791731933e-3,
    7.0178853015633142e-3,
    9.6678840157904983e-3,
    1.1193372947855113e-2,
    4.9106071261551805e-3,
    4.5073389116107756e-4,
};

/// this times -ln m1.
inline constexpr double K_log[] = {
    5.0000000000000000e-1,
    1.2499999999924014e-1,
    7.0312498097805502e-2,
    4.8827646554009247e-2,
    3.7356129216424472e-2,
    2.9759597576602862e-2,
    2.1745614361508011e-2,
    1.0719925646738057e-2,
    2.2806820316240609e-3,
    1.0377735120829858e-4,
};

/// Relative error 5.3e-17, before rounding; this part and
inline constexpr double E[] = {
    4.4314718055994529e-1,
    5.6805194677226467e-2,
    2.1832211802489806e-2,
    1.1600223901011230e-2,
    8.1078924826421235e-3,
    1.0103627989769140e-2,
    1.2498706975818389e-2,
    6.0863989342159799e-3,
    6.1488946302769336e-4,
};

/// this times -ln m1.
inline constexpr double E_log[] = {
    2.5000000000000000e-1,
    9.3749999750925164e-2,
    5.8593592089117701e-2,
    4.2710003129483837e-2,
    3.3281867800594717e-2,
    2.4623649309178046e-2,
    1.2797998494532305e-2,
    2.9322408318116437e-3,
    1.4404390553567256e-4,
};

/// Relative error 2.3e-9, before rounding; this part and
inline constexpr float K_float[] = {
    1.38629436f,
    9.66426950e-2f,
    3.50569865e-2f,
    3.65097630e-2f,
    1.62915991e-2f,
};

/// this times -ln m1.
inline constexpr float K_float_log[] = {
    5.00000000e-1f,
    1.24989196e-1f,
    6.90883272e-2f,
    3.49128104e-2f,
    5.17469915e-3f,
};

/// Relative error 2.2e-8, before rounding; this part and
inline constexpr float E_float[] = {
    4.43147181e-1f,
    5.85348356e-2f,
    4.34872136e-2f,
    2.56226377e-2f,
};

/// this times -ln m1.
inline constexpr float E_float_log[] = {
    2.50000000e-1f,
    9.33991658e-2f,
    4.83825621e-2f,
    8.74862378e-3f,
};

/// 2 atanh(h) / h - 2 over h^2, for h^2 < 0.0413; error 1.9e-17.
inline constexpr double atanh_tail[] = {
    6.6666666666674268e-1,
    3.9999999995325112e-1,
    2.8571429543072803e-1,
    2.2222126616831090e-1,
    1.8186835381100079e-1,
    1.5240743789841894e-1,
    1.5440542329346171e-1,
};

/// ln(1 + g) / g within a factor of sqrt(2) of 1; relative error 1.7e-7.
inline constexpr float log_over_g[] = {
    9.99999945e-1f,
    -5.00003651e-1f,
    3.33350570e-1f,
    -2.49699057e-1f,
    1.99002235e-1f,
    -1.72509386e-1f,
    1.62221471e-1f,
    -1.01059822e-1f,
};

}  // namespace slipfront::pulse::fit
