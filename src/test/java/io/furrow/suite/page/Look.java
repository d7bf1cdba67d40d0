package io.furrow.suite.page;

import com.microsoft.playwright.options.ColorScheme;

/** Size of the window, CSS pixels, and colours. */
record Look(int width, int height, ColorScheme scheme) {
    static final Look DESK = new Look(1440, 900, ColorScheme.DARK);
    static final Look DESK_LIGHT = new Look(1440, 900, ColorScheme.LIGHT);
    static final Look TABLET = new Look(768, 1024, ColorScheme.DARK);
    static final Look PHONE = new Look(390, 844, ColorScheme.DARK);
    static final Look PHONE_LIGHT = new Look(390, 844, ColorScheme.LIGHT);
}
