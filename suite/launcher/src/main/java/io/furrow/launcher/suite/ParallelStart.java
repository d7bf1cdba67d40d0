package io.furrow.launcher.suite;

import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;

/** Runs independent steps of a start in parallel, each on its own thread. */
final class ParallelStart {
    private ParallelStart() {}

    /** A step of the start; unlike {@code Callable}, without a result. */
    interface Step {
        void run() throws Exception;
    }

    /** Returns when all have ended. @throws CompletionException with the exception of one of them */
    static void run(Step... steps) {
        CompletableFuture<?>[] all = new CompletableFuture<?>[steps.length];
        for (int i = 0; i < steps.length; i++) {
            Step step = steps[i];
            all[i] = CompletableFuture.runAsync(
                    () -> {
                        try {
                            step.run();
                        } catch (Exception e) { // carried to the caller by the future
                            throw new CompletionException(e);
                        }
                    },
                    task -> new Thread(task, "start").start());
        }
        CompletableFuture.allOf(all).join();
    }
}
