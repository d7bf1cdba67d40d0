package io.furrow.unchecked;

import java.util.concurrent.Callable;

/** Converts checked exceptions into assertion errors, for use in lambdas. */
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
