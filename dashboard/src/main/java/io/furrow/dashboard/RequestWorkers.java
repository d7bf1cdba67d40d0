package io.furrow.dashboard;

import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Consumer;
import java.util.function.Predicate;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpStatus;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.dashboard.http.Problem;

/**
 * Runs requests that may wait for Kafka or the control plane on a thread pool of their own, so that the server's
 * threads stay free for all other requests. At most {@value #THREADS} requests run and {@value #WAITING} wait; further
 * ones are rejected with 503.
 */
final class RequestWorkers extends Handler.Wrapper {
    static final int THREADS = 32;
    static final int WAITING = 512;

    private static final long IDLE_SECONDS = 60;

    private final Predicate<String> mayWait;
    private final Consumer<Problem> onRejection;
    private final AtomicInteger threads = new AtomicInteger();
    private final ThreadPoolExecutor executor = new ThreadPoolExecutor(
            THREADS, THREADS, IDLE_SECONDS, TimeUnit.SECONDS, new LinkedBlockingQueue<>(WAITING), this::thread);

    /**
     * @param mayWait by path; other requests are handled on the server's thread
     * @param onRejection is notified of each rejected request
     */
    RequestWorkers(Predicate<String> mayWait, Consumer<Problem> onRejection, Handler handler) {
        super(handler);
        this.mayWait = mayWait;
        this.onRejection = onRejection;
        executor.allowCoreThreadTimeOut(true);
    }

    private Thread thread(Runnable task) {
        Thread thread = new Thread(task, "dashboard-work-" + threads.incrementAndGet());
        thread.setDaemon(true);
        return thread;
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) throws Exception {
        if (!mayWait.test(Request.getPathInContext(request))) {
            return super.handle(request, response, callback);
        }
        try {
            executor.execute(() -> run(request, response, callback));
        } catch (RejectedExecutionException e) {
            reject(response, callback);
        }
        return true;
    }

    private void run(Request request, Response response, Callback callback) {
        try {
            if (!super.handle(request, response, callback)) {
                Response.writeError(request, response, callback, HttpStatus.NOT_FOUND_404);
            }
        } catch (Throwable e) { // as Jetty does when a handler fails
            Response.writeError(request, response, callback, e);
        }
    }

    private void reject(Response response, Callback callback) {
        Problem problem = new Problem(
                503,
                "overloaded",
                "%d requests wait for Kafka or the control plane; try again in a moment".formatted(WAITING));
        onRejection.accept(problem);
        response.getHeaders().put(HttpHeader.RETRY_AFTER, "1");
        problem.answer(response, callback);
    }

    @Override
    protected void doStop() throws Exception {
        executor.shutdownNow();
        super.doStop();
    }
}
