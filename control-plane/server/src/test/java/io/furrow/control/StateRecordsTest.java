package io.furrow.control;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.StateJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Records of topics and stores are written as they were read, with and without their optional members. */
class StateRecordsTest {
    @ParameterizedTest
    @CsvSource(delimiter = ';', quoteCharacter = '"', textBlock = """
            alarm.Alarm; {'alarm':'collision-7','kind':'collision','subject':'a-b','severity':'critical','state':'acknowledged','change':'muted','text':'a and b are 1.0 m apart','values':{'meters':1.0},'devices':[{'id':'a','type':'T','service':'farm','servicePath':'/x'},{'id':'b'}],'raised':1,'changed':2,'count':3,'until':4,'mutedUntil':5,'acknowledgedBy':'ann','reason':'r','sequence':6,'group':'urn:m','affected':8,'total':9,'seen':10,'inhibitedBy':'silent-farm-1','identity':'farm|/|T|a-b'}
            alarm.Alarm; {'alarm':'fault-1','kind':'fault','subject':'s','severity':'warning','state':'open','change':'opened','text':'t','details':[{'code':'c','values':{'a':'1'}}],'devices':[],'raised':1,'changed':1,'count':1,'sequence':1,'seen':1}
            alarm.Alarm; {'alarm':'silent-farm-1','kind':'silent-farm','subject':'s','severity':'critical','state':'closed','change':'closed','text':'t','devices':[],'raised':1,'changed':1,'count':1,'reason':'over','sequence':1,'affected':3}
            health.DeviceHealth; {'id':'a','service':'farm','servicePath':'/','type':'T','domain':'d','mission':'m','silent':true,'since':7,'lastSeen':5,'heard':6,'deviceTime':4,'battery':0.5,'percent':true,'off':true}
            health.DeviceHealth; {'id':'a','service':'','servicePath':'/','domain':'','mission':'','silent':false,'since':7,'off':false}
            mission.MissionStatus; {'mission':'m','domain':'d','state':'starting','since':1,'sequence':2,'devices':3,'confirmed':1,'missing':[{'id':'a','reason':'r','code':'c','values':{'a':'1'}},{'id':'b'}],'reason':'r','due':4,'ends':5}
            mission.MissionStatus; {'mission':'m','domain':'d','state':'created','since':1,'sequence':2,'devices':0,'confirmed':0,'missing':[]}
            domain.Domain; {'domain':'d','name':'n','description':'x','area':{'type':'Polygon','coordinates':[1.50]},'fields':['f'],'created':1,'changed':2,'sequence':3}
            domain.Domain; {'domain':'d','fields':[],'created':1,'changed':2,'sequence':3}
            mission.Mission; {'mission':'m','domain':'d','template':'t@1','parts':1,'deviceCount':2,'running':true,'start':3,'duration':4,'created':5,'sequence':6}
            mission.Mission; {'mission':'m','domain':'d','parts':0,'deviceCount':0,'running':false,'created':5,'sequence':6}
            """)
    void preservesRecordsOfOlderVersions(String type, String record) throws ClassNotFoundException {
        String json = record.replace('\'', '"');
        Object read = StateJson.read(json.getBytes(UTF_8), Class.forName("io.furrow.control." + type));
        assertThat(new String(StateJson.write(read), UTF_8)).isEqualTo(json);
    }
}
