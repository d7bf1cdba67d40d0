package io.furrow.model.text;

import java.net.ConnectException;
import java.net.UnknownHostException;
import java.util.Locale;
import java.util.concurrent.CompletionException;
import java.util.concurrent.ExecutionException;
import java.util.regex.Pattern;

/** Why something failed, in words for people: what libraries say, without the names of their classes. */
public final class FailureText {
    private static final Pattern CLASS = Pattern.compile("\\b(?:[a-z_][\\w]*\\.){2,}[A-Z][\\w$]*(?:: )?");
    /** The state of MongoDB's driver as it prints it. */
    private static final Pattern STATE = Pattern.compile("\\. Client view of cluster state is .*", Pattern.DOTALL);

    private FailureText() {}

    /** A part of a sentence, for instance {@code connection refused}. */
    public static String of(Throwable failure) {
        Throwable cause = failure;
        while (cause.getCause() != null && isWrapper(cause)) {
            cause = cause.getCause();
        }
        String message = cause.getMessage();
        if (cause instanceof UnknownHostException) {
            return "there is no host of this name";
        } else if (message == null || message.isBlank()) {
            return cause instanceof ConnectException ? "connection refused" : words(cause.getClass());
        }
        return CLASS.matcher(STATE.matcher(message).replaceFirst("")).replaceAll("");
    }

    private static boolean isWrapper(Throwable failure) {
        return failure instanceof ExecutionException
                || failure instanceof CompletionException
                || failure.getMessage() == null && !(failure instanceof ConnectException)
                || failure.getCause().toString().equals(failure.getMessage());
    }

    /** What its class is called, as words: {@code closed channel}. */
    private static String words(Class<?> type) {
        return type.getSimpleName()
                .replaceFirst("(Exception|Error)$", "")
                .replaceAll("(?<=[a-z])(?=[A-Z])", " ")
                .toLowerCase(Locale.ROOT);
    }
}
