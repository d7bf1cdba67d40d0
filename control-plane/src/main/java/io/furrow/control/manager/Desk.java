package io.furrow.control.manager;

import io.furrow.model.control.RefusedException;
import io.furrow.model.control.Response;

/**
 * Who answers the requests of one manager.
 *
 * @param <C> its commands
 */
public interface Desk<C> {
    /**
     * Grants or refuses; what is refused has changed nothing.
     *
     * @param now epoch ms
     */
    Response answer(C command, long now) throws RefusedException;

    /** Called about once a second, and before the first request. */
    default void passTime(long now) {}
}
