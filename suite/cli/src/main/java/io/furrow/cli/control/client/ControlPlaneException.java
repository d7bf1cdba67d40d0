package io.furrow.cli.control.client;

import java.io.IOException;
import java.net.ConnectException;
import java.net.URI;
import java.net.UnknownHostException;
import java.util.Locale;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import javax.net.ssl.SSLException;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.model.text.FailureText;

/** The control plane is unavailable, or refused; the message says why and what to do. */
public final class ControlPlaneException extends RuntimeException {
    private static final long serialVersionUID = 1L;
    private static final Pattern MEMBER = Pattern.compile("(?:\\ba member |^)'(\\w+)'");

    private final boolean unknown;
    private final transient JsonNode problem;

    public ControlPlaneException(String message) {
        this(message, false, null);
    }

    /**
     * @param unknown whether the requested object does not exist
     * @param problem the answer; null if there is none
     */
    ControlPlaneException(String message, boolean unknown, JsonNode problem) {
        super(message);
        this.unknown = unknown;
        this.problem = problem;
    }

    public ControlPlaneException(String message, Throwable cause) {
        super(message, cause);
        this.unknown = false;
        this.problem = null;
    }

    /** @param base address of the control plane */
    static ControlPlaneException noAnswer(URI base, IOException e) {
        String sentence;
        if (e instanceof SSLException) {
            sentence = "The control plane at %s cannot be trusted (%s). Name the certificate of its CA with --api-ca.";
        } else if (e instanceof UnknownHostException) {
            sentence = "No control plane is at %s: %s. Check --api.";
        } else if (e instanceof ConnectException || "Connect timed out".equals(e.getMessage())) {
            sentence = "No control plane answers at %s. Is it running? ./furrow up starts one; --api names another.";
        } else {
            sentence = "The control plane at %s has not answered (%s). It may have carried a command out.";
        }
        return new ControlPlaneException(sentence.formatted(base, FailureText.of(e)), e);
    }

    /** Returns the message, with the option where the control plane names the member of the request that was made of it. */
    String sentence(CommandSpec spec) {
        return MEMBER.matcher(getMessage()).replaceAll(named -> {
            String option = "--" + named.group(1).replaceAll("([A-Z])", "-$1").toLowerCase(Locale.ROOT);
            return Matcher.quoteReplacement(spec.findOption(option) == null ? named.group() : option);
        });
    }

    /** Returns the refusal as the control plane answered it; null if there is none. */
    JsonNode problem() {
        return problem;
    }

    /** Whether the requested object does not exist. */
    public boolean isUnknown() {
        return unknown;
    }
}
