package io.furrow.launcher.suite;

import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;

/** Steps of a start that need not wait for each other, each on a thread of its own. */
final class ParallelStart {
    private ParallelStart() {}

    /** A step of the start; declared because {@code Callable} wants a result. */
    interface Step {
        void run() throws Exception;
    }

    /** Returns when all have ended. @throws CompletionException with what one of them threw */
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
