package io.furrow.suite.page;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;

/** A test of the page on a farm of stubs, one for each test, in one browser. */
abstract class StubbedPage {
    @AutoClose
    private static Chromium chromium;

    @AutoClose
    StubFarm farm;

    @BeforeAll
    static void launch() {
        chromium = Chromium.start();
    }

    @BeforeEach
    void startFarm() throws Exception {
        farm = new StubFarm(chromium);
    }
}
