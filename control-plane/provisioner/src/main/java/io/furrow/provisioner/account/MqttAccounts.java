package io.furrow.provisioner.account;

import java.io.IOException;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

/** Where accounts of devices and gateways are put, so that an MQTT broker knows them. */
public interface MqttAccounts {
    /**
     * Lets exactly these accounts be known from now on, and those that stay as they are; each user is there once. Called with all of
     * them after every change.
     *
     * @param retained users that stay if they are there
     * @return why, by user, of those that are not known because somebody else has a user of that name
     * @throws IOException naming what could not be written or run; it is called again later then
     */
    Map<String, String> replace(List<MqttAccount> accounts, Set<String> retained) throws IOException;

    /**
     * Removes the accounts of other users, also those that another process or an earlier start has put there.
     *
     * @param removable which of them may be removed; a login of a device stays anyway while {@code users} have only an earlier one of it
     * @return the other users that stay
     * @throws IOException as {@link #replace}
     */
    Set<String> retain(Set<String> users, Predicate<String> removable) throws IOException;

    /** Id of the topic whose devices have the accounts, where that was noted. */
    default Optional<String> origin() throws IOException {
        return Optional.empty();
    }

    /** Notes that all accounts are of devices of a topic. @param topic its id */
    default void noteOrigin(String topic) throws IOException {}
}
