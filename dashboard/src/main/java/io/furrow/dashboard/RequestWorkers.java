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
 * Runs requests that may wait for Kafka or the control plane on threads of their own, so that the server's threads
 * stay free for all others. At most {@value #THREADS} are answered at once and {@value #WAITING} wait; more are
 * refused with 503.
 */
final class RequestWorkers extends Handler.Wrapper {
    static final int THREADS = 32;
    static final int WAITING = 512;

    private static final long IDLE_SECONDS = 60;

    private final Predicate<String> mayWait;
    private final Consumer<Problem> refused;
    private final AtomicInteger threads = new AtomicInteger();
    private final ThreadPoolExecutor executor = new ThreadPoolExecutor(
            THREADS, THREADS, IDLE_SECONDS, TimeUnit.SECONDS, new LinkedBlockingQueue<>(WAITING), this::thread);

    /**
     * @param mayWait by path; the others are handled where they are
     * @param refused is notified of each request that is refused
     */
    RequestWorkers(Predicate<String> mayWait, Consumer<Problem> refused, Handler handler) {
        super(handler);
        this.mayWait = mayWait;
        this.refused = refused;
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
            executor.execute(() -> work(request, response, callback));
        } catch (RejectedExecutionException e) {
            refuse(response, callback);
        }
        return true;
    }

    private void work(Request request, Response response, Callback callback) {
        try {
            if (!super.handle(request, response, callback)) {
                Response.writeError(request, response, callback, HttpStatus.NOT_FOUND_404);
            }
        } catch (Throwable e) { // as the server does where it calls a handler
            Response.writeError(request, response, callback, e);
        }
    }

    private void refuse(Response response, Callback callback) {
        Problem problem = new Problem(
                503,
                "overloaded",
                "%d requests wait for Kafka or the control plane; ask again in a moment".formatted(WAITING));
        refused.accept(problem);
        response.getHeaders().put(HttpHeader.RETRY_AFTER, "1");
        problem.answer(response, callback);
    }

    @Override
    protected void doStop() throws Exception {
        executor.shutdownNow();
        super.doStop();
    }
}
