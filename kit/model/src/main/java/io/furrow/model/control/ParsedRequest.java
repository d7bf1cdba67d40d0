package io.furrow.model.control;

/**
 * A parsed record of a manager's topic.
 *
 * @param <C> the commands of that manager
 */
public sealed interface ParsedRequest<C> {
    /** @param requestId null if the request has none */
    record Request<C>(String requestId, C command) implements ParsedRequest<C> {}

    /**
     * An invalid request or other record.
     *
     * @param requestId null if it cannot be read
     * @param answer without the request's id
     */
    record Refused<C>(String requestId, CommandResult answer) implements ParsedRequest<C> {}

    /** A record that managers ignore: a response, or a record without a value. */
    record Passed<C>() implements ParsedRequest<C> {}
}
