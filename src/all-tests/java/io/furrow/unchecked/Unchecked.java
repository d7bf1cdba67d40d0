package io.furrow.unchecked;

import java.util.concurrent.Callable;

/** Lets what may throw stand where nothing may be thrown that is checked; it fails the test. */
public final class Unchecked {
    private Unchecked() {}

    public static <T> T get(Callable<T> call) {
        try {
            return call.call();
        } catch (RuntimeException e) {
            throw e;
        } catch (Exception e) {
            throw new AssertionError(e);
        }
    }
}
