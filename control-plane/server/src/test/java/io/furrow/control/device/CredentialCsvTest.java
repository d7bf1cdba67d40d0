package io.furrow.control.device;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class CredentialCsvTest {
    private static final String DEVICE = """
            {"device": "urn:t:1", "deviceId": "it's", "host": "farm.lan", "port": 8883, "tls": true, "user": "u", "password": "p,1",
             "apiKey": "k", "measures": "/k/t/attrs", "commands": "/k/t/cmd", "results": "/k/t/cmdexe",
             "attributes": [{"object_id": "t", "name": "Temperature"}, {"object_id": "bat", "name": "battery"}],
             "example": "mosquitto_pub -m '{\\"t\\":21}'"}""";

    @Test
    void writesCsvForSpreadsheets() throws Exception {
        assertThat(CredentialCsv.of(List.of(NgsiJson.mapper().readTree(DEVICE))))
                .isEqualTo(
                        "device,deviceId,host,port,tls,user,password,apiKey,measures,commands,results,attributes,example\r\n"
                                + "urn:t:1,it's,farm.lan,8883,true,u,\"p,1\",k,/k/t/attrs,/k/t/cmd,/k/t/cmdexe,t=Temperature bat=battery,"
                                + "\"mosquitto_pub -m '{\"\"t\"\":21}'\"\r\n");
    }
}
