package io.furrow.model.text;

import java.net.ConnectException;
import java.net.UnknownHostException;
import java.util.Locale;
import java.util.concurrent.CompletionException;
import java.util.concurrent.ExecutionException;
import java.util.regex.Pattern;

/** Describes failures for people: the messages of libraries without class names. */
public final class FailureText {
    private static final Pattern CLASS = Pattern.compile("\\b(?:[a-z_][\\w]*\\.){2,}[A-Z][\\w$]*(?:: )?");
    /** The state that MongoDB's driver adds to its messages. */
    private static final Pattern STATE = Pattern.compile("\\. Client view of cluster state is .*", Pattern.DOTALL);

    private static final String CAUSE = "Caused by: ";

    private FailureText() {}

    /** Returns a part of a sentence, for instance {@code connection refused}. */
    public static String of(Throwable failure) {
        Throwable cause = failure;
        while (cause.getCause() != null && isWrapper(cause)) {
            cause = cause.getCause();
        }
        String message = cause.getMessage();
        if (cause instanceof UnknownHostException) {
            return "there is no host of this name";
        } else if (message == null || message.isBlank()) {
            return cause instanceof ConnectException
                    ? "connection refused"
                    : words(cause.getClass().getSimpleName());
        }
        String text = CLASS.matcher(STATE.matcher(message).replaceFirst("")).replaceAll("");
        return cause instanceof Error ? words(cause.getClass().getSimpleName()) + ": " + text : text;
    }

    /** Returns the failure of a stage without the exception that wraps it. @param failure null if the stage succeeded */
    public static Throwable unwrap(Throwable failure) {
        return failure instanceof CompletionException && failure.getCause() != null ? failure.getCause() : failure;
    }

    /** Returns the description of a printed stack trace: the first line of its deepest cause. */
    public static String ofTrace(String trace) {
        String cause = trace.lines()
                .filter(line -> line.startsWith(CAUSE))
                .reduce((outer, inner) -> inner)
                .map(line -> line.substring(CAUSE.length()))
                .orElseGet(() -> trace.lines().findFirst().orElse(""));
        String text = CLASS.matcher(cause).replaceAll("").strip();
        return text.isEmpty() ? words(cause.substring(cause.lastIndexOf('.') + 1)) : text;
    }

    private static boolean isWrapper(Throwable failure) {
        if (failure instanceof ConnectException) { // Java's HTTP client adds the same exception as the cause
            return false;
        }
        return failure instanceof ExecutionException
                || failure instanceof CompletionException
                || failure.getMessage() == null && !(failure instanceof ConnectException)
                || failure.getCause().toString().equals(failure.getMessage());
    }

    /** Returns the name of a class as words: {@code closed channel}. */
    private static String words(String type) {
        return type.replaceFirst("(Exception|Error)$", "")
                .replaceAll("(?<=[a-z])(?=[A-Z])", " ")
                .toLowerCase(Locale.ROOT);
    }
}
