package io.furrow.suite.page;

import com.microsoft.playwright.options.ColorScheme;

/** Size of a window in CSS pixels, and its color scheme. */
record WindowStyle(int width, int height, ColorScheme scheme) {
    static final WindowStyle DESKTOP = new WindowStyle(1440, 900, ColorScheme.DARK);
    static final WindowStyle DESKTOP_LIGHT = new WindowStyle(1440, 900, ColorScheme.LIGHT);
    static final WindowStyle TABLET = new WindowStyle(768, 1024, ColorScheme.DARK);
    static final WindowStyle PHONE = new WindowStyle(390, 844, ColorScheme.DARK);
    static final WindowStyle PHONE_LIGHT = new WindowStyle(390, 844, ColorScheme.LIGHT);
}
