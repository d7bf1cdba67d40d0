package io.furrow.control.provisioning;

import java.io.IOException;
import java.util.List;

/** Where accounts of devices and gateways are put, so that an MQTT broker knows them. */
public interface MqttAccounts {
    /**
     * Lets exactly these accounts be known from now on; each user is there once. Called with all of them after every change.
     *
     * @throws IOException naming what could not be written or run; it is called again later then
     */
    void replace(List<MqttAccount> accounts) throws IOException;
}
