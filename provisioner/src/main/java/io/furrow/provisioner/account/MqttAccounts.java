package io.furrow.provisioner.account;

import java.io.IOException;
import java.util.List;
import java.util.Map;
import java.util.Set;

/** Where accounts of devices and gateways are put, so that an MQTT broker knows them. */
public interface MqttAccounts {
    /**
     * Lets exactly these accounts be known from now on; each user is there once. Called with all of them after every change.
     *
     * @return why, by user, of those that are not known because somebody else has a user of that name
     * @throws IOException naming what could not be written or run; it is called again later then
     */
    Map<String, String> replace(List<MqttAccount> accounts) throws IOException;

    /**
     * Removes the accounts of all other users, also those that another process or an earlier start has put there.
     *
     * @throws IOException as {@link #replace}
     */
    void retain(Set<String> users) throws IOException;
}
