package io.furrow.provisioner.account;

import java.io.IOException;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.BiPredicate;
import java.util.function.Predicate;

import io.furrow.model.device.FarmSecret;

/** Stores accounts of devices and gateways where an MQTT broker reads them. */
public interface MqttAccounts {
    /**
     * Replaces all accounts; each user occurs once. Called with the complete list after every change.
     *
     * @param retained users that stay if they exist
     * @return the reason, by user, for each account that was rejected because a foreign user has the same name
     * @throws IOException naming what could not be written or executed; the caller retries
     */
    Map<String, String> replace(List<MqttAccount> accounts, Set<String> retained) throws IOException;

    /**
     * Removes the accounts of other users, including those written by another process or an earlier run.
     *
     * @param removable tells which of them may be removed, by name and by whether a login is that of the account; a
     *     later login of a device than that in {@code users} always stays
     * @return the retained other users
     * @throws IOException as {@link #replace}
     */
    Set<String> retain(Set<String> users, BiPredicate<String, Predicate<FarmSecret.Login>> removable)
            throws IOException;

    /** Returns the recorded id of the topic whose devices have the accounts. */
    default Optional<String> origin() throws IOException {
        return Optional.empty();
    }

    /** Records the topic whose devices have all accounts. @param topic its id */
    default void recordOrigin(String topic) throws IOException {}
}
