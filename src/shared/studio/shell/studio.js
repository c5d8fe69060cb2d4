var studioAddress="studio://page/studio.js",studioOrigin="null";
(()=>{var ws=(i=>typeof require<"u"?require:typeof Proxy<"u"?new Proxy(i,{get:(t,e)=>(typeof require<"u"?require:t)[e]}):i)(function(i){if(typeof require<"u")return require.apply(this,arguments);throw Error('Dynamic require of "'+i+'" is not supported')});var Kh=Object.defineProperty,z_=Object.getOwnPropertyDescriptor,G_=Object.getOwnPropertyNames,V_=Object.prototype.hasOwnProperty,H_=(i=>typeof ws<"u"?ws:typeof Proxy<"u"?new Proxy(i,{get:(t,e)=>(typeof ws<"u"?ws:t)[e]}):i)(function(i){if(typeof ws<"u")return ws.apply(this,arguments);throw Error('Dynamic require of "'+i+'" is not supported')}),de=(i,t)=>()=>(i&&(t=i(i=0)),t),zo=(i,t)=>{for(var e in t)Kh(i,e,{get:t[e],enumerable:!0})},W_=(i,t,e,n)=>{if(t&&typeof t=="object"||typeof t=="function")for(let s of G_(t))!V_.call(i,s)&&s!==e&&Kh(i,s,{get:()=>t[s],enumerable:!(n=z_(t,s))||n.enumerable});return i},$h=i=>W_(Kh({},"__esModule",{value:!0}),i),sa,ji,Fo,zd,ip,sp=de(()=>{"use strict";sa=new Map,ji=[],Fo=(i,t,e)=>{if(t&&typeof t.init=="function"&&typeof t.createInferenceSessionHandler=="function"){let n=sa.get(i);if(n===void 0)sa.set(i,{backend:t,priority:e});else{if(n.priority>e)return;if(n.priority===e&&n.backend!==t)throw new Error(`cannot register backend "${i}" using priority ${e}`)}if(e>=0){let s=ji.indexOf(i);s!==-1&&ji.splice(s,1);for(let r=0;r<ji.length;r++)if(sa.get(ji[r]).priority<=e){ji.splice(r,0,i);return}ji.push(i)}return}throw new TypeError("not a valid backend")},zd=async i=>{let t=sa.get(i);if(!t)return"backend not found.";if(t.initialized)return t.backend;if(t.aborted)return t.error;{let e=!!t.initPromise;try{return e||(t.initPromise=t.backend.init(i)),await t.initPromise,t.initialized=!0,t.backend}catch(n){return e||(t.error=`${n}`,t.aborted=!0),t.error}finally{delete t.initPromise}}},ip=async i=>{let t=i.executionProviders||[],e=t.map(l=>typeof l=="string"?l:l.name),n=e.length===0?ji:e,s,r=[],a=new Set;for(let l of n){let c=await zd(l);typeof c=="string"?r.push({name:l,err:c}):(s||(s=c),s===c&&a.add(l))}if(!s)throw new Error(`no available backend found. ERR: ${r.map(l=>`[${l.name}] ${l.err}`).join(", ")}`);for(let{name:l,err:c}of r)e.includes(l)&&console.warn(`removing requested execution provider "${l}" from session options because it is not available: ${c}`);let o=t.filter(l=>a.has(typeof l=="string"?l:l.name));return[s,new Proxy(i,{get:(l,c)=>c==="executionProviders"?o:Reflect.get(l,c)})]}}),X_=de(()=>{"use strict";sp()}),rp,$_=de(()=>{"use strict";rp="1.23.2"}),Ph,an,ap=de(()=>{"use strict";$_(),Ph="warning",an={wasm:{},webgl:{},webgpu:{},versions:{common:rp},set logLevel(i){if(i!==void 0){if(typeof i!="string"||["verbose","info","warning","error","fatal"].indexOf(i)===-1)throw new Error(`Unsupported logging level: ${i}`);Ph=i}},get logLevel(){return Ph}},Object.defineProperty(an,"logLevel",{enumerable:!0})}),Ce,q_=de(()=>{"use strict";ap(),Ce=an}),op,lp,Y_=de(()=>{"use strict";op=(i,t)=>{let e=typeof document<"u"?document.createElement("canvas"):new OffscreenCanvas(1,1);e.width=i.dims[3],e.height=i.dims[2];let n=e.getContext("2d");if(n!=null){let s,r;t?.tensorLayout!==void 0&&t.tensorLayout==="NHWC"?(s=i.dims[2],r=i.dims[3]):(s=i.dims[3],r=i.dims[2]);let a=t?.format!==void 0?t.format:"RGB",o=t?.norm,l,c;o===void 0||o.mean===void 0?l=[255,255,255,255]:typeof o.mean=="number"?l=[o.mean,o.mean,o.mean,o.mean]:(l=[o.mean[0],o.mean[1],o.mean[2],0],o.mean[3]!==void 0&&(l[3]=o.mean[3])),o===void 0||o.bias===void 0?c=[0,0,0,0]:typeof o.bias=="number"?c=[o.bias,o.bias,o.bias,o.bias]:(c=[o.bias[0],o.bias[1],o.bias[2],0],o.bias[3]!==void 0&&(c[3]=o.bias[3]));let h=r*s,u=0,f=h,d=h*2,p=-1;a==="RGBA"?(u=0,f=h,d=h*2,p=h*3):a==="RGB"?(u=0,f=h,d=h*2):a==="RBG"&&(u=0,d=h,f=h*2);for(let _=0;_<r;_++)for(let m=0;m<s;m++){let g=(i.data[u++]-c[0])*l[0],x=(i.data[f++]-c[1])*l[1],w=(i.data[d++]-c[2])*l[2],M=p===-1?255:(i.data[p++]-c[3])*l[3];n.fillStyle="rgba("+g+","+x+","+w+","+M+")",n.fillRect(m,_,1,1)}if("toDataURL"in e)return e.toDataURL();throw new Error("toDataURL is not supported")}else throw new Error("Can not access image data")},lp=(i,t)=>{let e=typeof document<"u"?document.createElement("canvas").getContext("2d"):new OffscreenCanvas(1,1).getContext("2d"),n;if(e!=null){let s,r,a;t?.tensorLayout!==void 0&&t.tensorLayout==="NHWC"?(s=i.dims[2],r=i.dims[1],a=i.dims[3]):(s=i.dims[3],r=i.dims[2],a=i.dims[1]);let o=t!==void 0&&t.format!==void 0?t.format:"RGB",l=t?.norm,c,h;l===void 0||l.mean===void 0?c=[255,255,255,255]:typeof l.mean=="number"?c=[l.mean,l.mean,l.mean,l.mean]:(c=[l.mean[0],l.mean[1],l.mean[2],255],l.mean[3]!==void 0&&(c[3]=l.mean[3])),l===void 0||l.bias===void 0?h=[0,0,0,0]:typeof l.bias=="number"?h=[l.bias,l.bias,l.bias,l.bias]:(h=[l.bias[0],l.bias[1],l.bias[2],0],l.bias[3]!==void 0&&(h[3]=l.bias[3]));let u=r*s;if(t!==void 0&&(t.format!==void 0&&a===4&&t.format!=="RGBA"||a===3&&t.format!=="RGB"&&t.format!=="BGR"))throw new Error("Tensor format doesn't match input tensor dims");let f=4,d=0,p=1,_=2,m=3,g=0,x=u,w=u*2,M=-1;o==="RGBA"?(g=0,x=u,w=u*2,M=u*3):o==="RGB"?(g=0,x=u,w=u*2):o==="RBG"&&(g=0,w=u,x=u*2),n=e.createImageData(s,r);for(let E=0;E<r*s;d+=f,p+=f,_+=f,m+=f,E++)n.data[d]=(i.data[g++]-h[0])*c[0],n.data[p]=(i.data[x++]-h[1])*c[1],n.data[_]=(i.data[w++]-h[2])*c[2],n.data[m]=M===-1?255:(i.data[M++]-h[3])*c[3]}else throw new Error("Can not access image data");return n}}),Io,cp,hp,up,fp,dp,Z_=de(()=>{"use strict";jh(),Io=(i,t)=>{if(i===void 0)throw new Error("Image buffer must be defined");if(t.height===void 0||t.width===void 0)throw new Error("Image height and width must be defined");if(t.tensorLayout==="NHWC")throw new Error("NHWC Tensor layout is not supported yet");let{height:e,width:n}=t,s=t.norm??{mean:255,bias:0},r,a;typeof s.mean=="number"?r=[s.mean,s.mean,s.mean,s.mean]:r=[s.mean[0],s.mean[1],s.mean[2],s.mean[3]??255],typeof s.bias=="number"?a=[s.bias,s.bias,s.bias,s.bias]:a=[s.bias[0],s.bias[1],s.bias[2],s.bias[3]??0];let o=t.format!==void 0?t.format:"RGBA",l=t.tensorFormat!==void 0&&t.tensorFormat!==void 0?t.tensorFormat:"RGB",c=e*n,h=l==="RGBA"?new Float32Array(c*4):new Float32Array(c*3),u=4,f=0,d=1,p=2,_=3,m=0,g=c,x=c*2,w=-1;o==="RGB"&&(u=3,f=0,d=1,p=2,_=-1),l==="RGBA"?w=c*3:l==="RBG"?(m=0,x=c,g=c*2):l==="BGR"&&(x=0,g=c,m=c*2);for(let M=0;M<c;M++,f+=u,p+=u,d+=u,_+=u)h[m++]=(i[f]+a[0])/r[0],h[g++]=(i[d]+a[1])/r[1],h[x++]=(i[p]+a[2])/r[2],w!==-1&&_!==-1&&(h[w++]=(i[_]+a[3])/r[3]);return l==="RGBA"?new Hn("float32",h,[1,4,e,n]):new Hn("float32",h,[1,3,e,n])},cp=async(i,t)=>{let e=typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement,n=typeof ImageData<"u"&&i instanceof ImageData,s=typeof ImageBitmap<"u"&&i instanceof ImageBitmap,r=typeof i=="string",a,o=t??{},l=()=>{if(typeof document<"u")return document.createElement("canvas");if(typeof OffscreenCanvas<"u")return new OffscreenCanvas(1,1);throw new Error("Canvas is not supported")},c=h=>typeof HTMLCanvasElement<"u"&&h instanceof HTMLCanvasElement||h instanceof OffscreenCanvas?h.getContext("2d"):null;if(e){let h=l();h.width=i.width,h.height=i.height;let u=c(h);if(u!=null){let f=i.height,d=i.width;if(t!==void 0&&t.resizedHeight!==void 0&&t.resizedWidth!==void 0&&(f=t.resizedHeight,d=t.resizedWidth),t!==void 0){if(o=t,t.tensorFormat!==void 0)throw new Error("Image input config format must be RGBA for HTMLImageElement");o.tensorFormat="RGBA",o.height=f,o.width=d}else o.tensorFormat="RGBA",o.height=f,o.width=d;u.drawImage(i,0,0),a=u.getImageData(0,0,d,f).data}else throw new Error("Can not access image data")}else if(n){let h,u;if(t!==void 0&&t.resizedWidth!==void 0&&t.resizedHeight!==void 0?(h=t.resizedHeight,u=t.resizedWidth):(h=i.height,u=i.width),t!==void 0&&(o=t),o.format="RGBA",o.height=h,o.width=u,t!==void 0){let f=l();f.width=u,f.height=h;let d=c(f);if(d!=null)d.putImageData(i,0,0),a=d.getImageData(0,0,u,h).data;else throw new Error("Can not access image data")}else a=i.data}else if(s){if(t===void 0)throw new Error("Please provide image config with format for Imagebitmap");let h=l();h.width=i.width,h.height=i.height;let u=c(h);if(u!=null){let f=i.height,d=i.width;return u.drawImage(i,0,0,d,f),a=u.getImageData(0,0,d,f).data,o.height=f,o.width=d,Io(a,o)}else throw new Error("Can not access image data")}else{if(r)return new Promise((h,u)=>{let f=l(),d=c(f);if(!i||!d)return u();let p=new Image;p.crossOrigin="Anonymous",p.src=i,p.onload=()=>{f.width=p.width,f.height=p.height,d.drawImage(p,0,0,f.width,f.height);let _=d.getImageData(0,0,f.width,f.height);o.height=f.height,o.width=f.width,h(Io(_.data,o))}});throw new Error("Input data provided is not supported - aborted tensor creation")}if(a!==void 0)return Io(a,o);throw new Error("Input data provided is not supported - aborted tensor creation")},hp=(i,t)=>{let{width:e,height:n,download:s,dispose:r}=t,a=[1,n,e,4];return new Hn({location:"texture",type:"float32",texture:i,dims:a,download:s,dispose:r})},up=(i,t)=>{let{dataType:e,dims:n,download:s,dispose:r}=t;return new Hn({location:"gpu-buffer",type:e??"float32",gpuBuffer:i,dims:n,download:s,dispose:r})},fp=(i,t)=>{let{dataType:e,dims:n,download:s,dispose:r}=t;return new Hn({location:"ml-tensor",type:e??"float32",mlTensor:i,dims:n,download:s,dispose:r})},dp=(i,t,e)=>new Hn({location:"cpu-pinned",type:i,data:t,dims:e??[t.length]})}),As,ca,Ih,pp,J_=de(()=>{"use strict";As=new Map([["float32",Float32Array],["uint8",Uint8Array],["int8",Int8Array],["uint16",Uint16Array],["int16",Int16Array],["int32",Int32Array],["bool",Uint8Array],["float64",Float64Array],["uint32",Uint32Array],["int4",Uint8Array],["uint4",Uint8Array]]),ca=new Map([[Float32Array,"float32"],[Uint8Array,"uint8"],[Int8Array,"int8"],[Uint16Array,"uint16"],[Int16Array,"int16"],[Int32Array,"int32"],[Float64Array,"float64"],[Uint32Array,"uint32"]]),Ih=!1,pp=()=>{if(!Ih){Ih=!0;let i=typeof BigInt64Array<"u"&&BigInt64Array.from,t=typeof BigUint64Array<"u"&&BigUint64Array.from,e=globalThis.Float16Array,n=typeof e<"u"&&e.from;i&&(As.set("int64",BigInt64Array),ca.set(BigInt64Array,"int64")),t&&(As.set("uint64",BigUint64Array),ca.set(BigUint64Array,"uint64")),n?(As.set("float16",e),ca.set(e,"float16")):As.set("float16",Uint16Array)}}}),mp,gp,K_=de(()=>{"use strict";jh(),mp=i=>{let t=1;for(let e=0;e<i.length;e++){let n=i[e];if(typeof n!="number"||!Number.isSafeInteger(n))throw new TypeError(`dims[${e}] must be an integer, got: ${n}`);if(n<0)throw new RangeError(`dims[${e}] must be a non-negative integer, got: ${n}`);t*=n}return t},gp=(i,t)=>{switch(i.location){case"cpu":return new Hn(i.type,i.data,t);case"cpu-pinned":return new Hn({location:"cpu-pinned",data:i.data,type:i.type,dims:t});case"texture":return new Hn({location:"texture",texture:i.texture,type:i.type,dims:t});case"gpu-buffer":return new Hn({location:"gpu-buffer",gpuBuffer:i.gpuBuffer,type:i.type,dims:t});case"ml-tensor":return new Hn({location:"ml-tensor",mlTensor:i.mlTensor,type:i.type,dims:t});default:throw new Error(`tensorReshape: tensor location ${i.location} is not supported`)}}}),Hn,jh=de(()=>{"use strict";Y_(),Z_(),J_(),K_(),Hn=class{constructor(i,t,e){pp();let n,s;if(typeof i=="object"&&"location"in i)switch(this.dataLocation=i.location,n=i.type,s=i.dims,i.location){case"cpu-pinned":{let a=As.get(n);if(!a)throw new TypeError(`unsupported type "${n}" to create tensor from pinned buffer`);if(!(i.data instanceof a))throw new TypeError(`buffer should be of type ${a.name}`);this.cpuData=i.data;break}case"texture":{if(n!=="float32")throw new TypeError(`unsupported type "${n}" to create tensor from texture`);this.gpuTextureData=i.texture,this.downloader=i.download,this.disposer=i.dispose;break}case"gpu-buffer":{if(n!=="float32"&&n!=="float16"&&n!=="int32"&&n!=="int64"&&n!=="uint32"&&n!=="uint8"&&n!=="bool"&&n!=="uint4"&&n!=="int4")throw new TypeError(`unsupported type "${n}" to create tensor from gpu buffer`);this.gpuBufferData=i.gpuBuffer,this.downloader=i.download,this.disposer=i.dispose;break}case"ml-tensor":{if(n!=="float32"&&n!=="float16"&&n!=="int32"&&n!=="int64"&&n!=="uint32"&&n!=="uint64"&&n!=="int8"&&n!=="uint8"&&n!=="bool"&&n!=="uint4"&&n!=="int4")throw new TypeError(`unsupported type "${n}" to create tensor from MLTensor`);this.mlTensorData=i.mlTensor,this.downloader=i.download,this.disposer=i.dispose;break}default:throw new Error(`Tensor constructor: unsupported location '${this.dataLocation}'`)}else{let a,o;if(typeof i=="string")if(n=i,o=e,i==="string"){if(!Array.isArray(t))throw new TypeError("A string tensor's data must be a string array.");a=t}else{let l=As.get(i);if(l===void 0)throw new TypeError(`Unsupported tensor type: ${i}.`);if(Array.isArray(t)){if(i==="float16"&&l===Uint16Array||i==="uint4"||i==="int4")throw new TypeError(`Creating a ${i} tensor from number array is not supported. Please use ${l.name} as data.`);i==="uint64"||i==="int64"?a=l.from(t,BigInt):a=l.from(t)}else if(t instanceof l)a=t;else if(t instanceof Uint8ClampedArray)if(i==="uint8")a=Uint8Array.from(t);else throw new TypeError("A Uint8ClampedArray tensor's data must be type of uint8");else if(i==="float16"&&t instanceof Uint16Array&&l!==Uint16Array)a=new globalThis.Float16Array(t.buffer,t.byteOffset,t.length);else throw new TypeError(`A ${n} tensor's data must be type of ${l}`)}else if(o=t,Array.isArray(i)){if(i.length===0)throw new TypeError("Tensor type cannot be inferred from an empty array.");let l=typeof i[0];if(l==="string")n="string",a=i;else if(l==="boolean")n="bool",a=Uint8Array.from(i);else throw new TypeError(`Invalid element type of data array: ${l}.`)}else if(i instanceof Uint8ClampedArray)n="uint8",a=Uint8Array.from(i);else{let l=ca.get(i.constructor);if(l===void 0)throw new TypeError(`Unsupported type for tensor data: ${i.constructor}.`);n=l,a=i}if(o===void 0)o=[a.length];else if(!Array.isArray(o))throw new TypeError("A tensor's dims must be a number array");s=o,this.cpuData=a,this.dataLocation="cpu"}let r=mp(s);if(this.cpuData&&r!==this.cpuData.length&&!((n==="uint4"||n==="int4")&&Math.ceil(r/2)===this.cpuData.length))throw new Error(`Tensor's size(${r}) does not match data length(${this.cpuData.length}).`);this.type=n,this.dims=s,this.size=r}static async fromImage(i,t){return cp(i,t)}static fromTexture(i,t){return hp(i,t)}static fromGpuBuffer(i,t){return up(i,t)}static fromMLTensor(i,t){return fp(i,t)}static fromPinnedBuffer(i,t,e){return dp(i,t,e)}toDataURL(i){return op(this,i)}toImageData(i){return lp(this,i)}get data(){if(this.ensureValid(),!this.cpuData)throw new Error("The data is not on CPU. Use `getData()` to download GPU data to CPU, or use `texture` or `gpuBuffer` property to access the GPU data directly.");return this.cpuData}get location(){return this.dataLocation}get texture(){if(this.ensureValid(),!this.gpuTextureData)throw new Error("The data is not stored as a WebGL texture.");return this.gpuTextureData}get gpuBuffer(){if(this.ensureValid(),!this.gpuBufferData)throw new Error("The data is not stored as a WebGPU buffer.");return this.gpuBufferData}get mlTensor(){if(this.ensureValid(),!this.mlTensorData)throw new Error("The data is not stored as a WebNN MLTensor.");return this.mlTensorData}async getData(i){switch(this.ensureValid(),this.dataLocation){case"cpu":case"cpu-pinned":return this.data;case"texture":case"gpu-buffer":case"ml-tensor":{if(!this.downloader)throw new Error("The current tensor is not created with a specified data downloader.");if(this.isDownloading)throw new Error("The current tensor is being downloaded.");try{this.isDownloading=!0;let t=await this.downloader();return this.downloader=void 0,this.dataLocation="cpu",this.cpuData=t,i&&this.disposer&&(this.disposer(),this.disposer=void 0),t}finally{this.isDownloading=!1}}default:throw new Error(`cannot get data from location: ${this.dataLocation}`)}}dispose(){if(this.isDownloading)throw new Error("The current tensor is being downloaded.");this.disposer&&(this.disposer(),this.disposer=void 0),this.cpuData=void 0,this.gpuTextureData=void 0,this.gpuBufferData=void 0,this.mlTensorData=void 0,this.downloader=void 0,this.isDownloading=void 0,this.dataLocation="none"}ensureValid(){if(this.dataLocation==="none")throw new Error("The tensor is disposed.")}reshape(i){if(this.ensureValid(),this.downloader||this.disposer)throw new Error("Cannot reshape a tensor that owns GPU resource.");return gp(this,i)}}}),on,_p=de(()=>{"use strict";jh(),on=Hn}),qh,Lh,nr,ir,sr,rr,yp=de(()=>{"use strict";ap(),qh=(i,t)=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||console.timeStamp(`${i}::ORT::${t}`)},Lh=(i,t)=>{let e=new Error().stack?.split(/\r\n|\r|\n/g)||[],n=!1;for(let s=0;s<e.length;s++){if(n&&!e[s].includes("TRACE_FUNC")){let r=`FUNC_${i}::${e[s].trim().split(" ")[1]}`;t&&(r+=`::${t}`),qh("CPU",r);return}e[s].includes("TRACE_FUNC")&&(n=!0)}},nr=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||Lh("BEGIN",i)},ir=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||Lh("END",i)},sr=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||console.time(`ORT::${i}`)},rr=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||console.timeEnd(`ORT::${i}`)}}),xp,j_=de(()=>{"use strict";sp(),_p(),yp(),xp=class vp{constructor(t){this.handler=t}async run(t,e,n){nr(),sr("InferenceSession.run");let s={},r={};if(typeof t!="object"||t===null||t instanceof on||Array.isArray(t))throw new TypeError("'feeds' must be an object that use input names as keys and OnnxValue as corresponding values.");let a=!0;if(typeof e=="object"){if(e===null)throw new TypeError("Unexpected argument[1]: cannot be null.");if(e instanceof on)throw new TypeError("'fetches' cannot be a Tensor");if(Array.isArray(e)){if(e.length===0)throw new TypeError("'fetches' cannot be an empty array.");a=!1;for(let c of e){if(typeof c!="string")throw new TypeError("'fetches' must be a string array or an object.");if(this.outputNames.indexOf(c)===-1)throw new RangeError(`'fetches' contains invalid output name: ${c}.`);s[c]=null}if(typeof n=="object"&&n!==null)r=n;else if(typeof n<"u")throw new TypeError("'options' must be an object.")}else{let c=!1,h=Object.getOwnPropertyNames(e);for(let u of this.outputNames)if(h.indexOf(u)!==-1){let f=e[u];(f===null||f instanceof on)&&(c=!0,a=!1,s[u]=f)}if(c){if(typeof n=="object"&&n!==null)r=n;else if(typeof n<"u")throw new TypeError("'options' must be an object.")}else r=e}}else if(typeof e<"u")throw new TypeError("Unexpected argument[1]: must be 'fetches' or 'options'.");for(let c of this.inputNames)if(typeof t[c]>"u")throw new Error(`input '${c}' is missing in 'feeds'.`);if(a)for(let c of this.outputNames)s[c]=null;let o=await this.handler.run(t,s,r),l={};for(let c in o)if(Object.hasOwnProperty.call(o,c)){let h=o[c];h instanceof on?l[c]=h:l[c]=new on(h.type,h.data,h.dims)}return rr("InferenceSession.run"),ir(),l}async release(){return this.handler.dispose()}static async create(t,e,n,s){nr(),sr("InferenceSession.create");let r,a={};if(typeof t=="string"){if(r=t,typeof e=="object"&&e!==null)a=e;else if(typeof e<"u")throw new TypeError("'options' must be an object.")}else if(t instanceof Uint8Array){if(r=t,typeof e=="object"&&e!==null)a=e;else if(typeof e<"u")throw new TypeError("'options' must be an object.")}else if(t instanceof ArrayBuffer||typeof SharedArrayBuffer<"u"&&t instanceof SharedArrayBuffer){let h=t,u=0,f=t.byteLength;if(typeof e=="object"&&e!==null)a=e;else if(typeof e=="number"){if(u=e,!Number.isSafeInteger(u))throw new RangeError("'byteOffset' must be an integer.");if(u<0||u>=h.byteLength)throw new RangeError(`'byteOffset' is out of range [0, ${h.byteLength}).`);if(f=t.byteLength-u,typeof n=="number"){if(f=n,!Number.isSafeInteger(f))throw new RangeError("'byteLength' must be an integer.");if(f<=0||u+f>h.byteLength)throw new RangeError(`'byteLength' is out of range (0, ${h.byteLength-u}].`);if(typeof s=="object"&&s!==null)a=s;else if(typeof s<"u")throw new TypeError("'options' must be an object.")}else if(typeof n<"u")throw new TypeError("'byteLength' must be a number.")}else if(typeof e<"u")throw new TypeError("'options' must be an object.");r=new Uint8Array(h,u,f)}else throw new TypeError("Unexpected argument[0]: must be 'path' or 'buffer'.");let[o,l]=await ip(a),c=await o.createInferenceSessionHandler(r,l);return rr("InferenceSession.create"),ir(),new vp(c)}startProfiling(){this.handler.startProfiling()}endProfiling(){this.handler.endProfiling()}get inputNames(){return this.handler.inputNames}get outputNames(){return this.handler.outputNames}get inputMetadata(){return this.handler.inputMetadata}get outputMetadata(){return this.handler.outputMetadata}}}),Go,Q_=de(()=>{"use strict";j_(),Go=xp}),ty=de(()=>{"use strict"}),ey=de(()=>{"use strict"}),ny=de(()=>{"use strict"}),iy=de(()=>{"use strict"}),sy={};zo(sy,{InferenceSession:()=>Go,TRACE:()=>qh,TRACE_EVENT_BEGIN:()=>sr,TRACE_EVENT_END:()=>rr,TRACE_FUNC_BEGIN:()=>nr,TRACE_FUNC_END:()=>ir,Tensor:()=>on,env:()=>Ce,registerBackend:()=>Fo});var Ts=de(()=>{"use strict";X_(),q_(),Q_(),_p(),ty(),ey(),yp(),ny(),iy()}),Qh=de(()=>{"use strict"}),Mp={};zo(Mp,{default:()=>wp});var Nh,Dh,wp,ry=de(()=>{"use strict";Op(),ar(),tu(),Nh="ort-wasm-proxy-worker",Dh=globalThis.self?.name===Nh,Dh&&(self.onmessage=i=>{let{type:t,in:e}=i.data;try{switch(t){case"init-wasm":eu(e.wasm).then(()=>{au(e).then(()=>{postMessage({type:t})},n=>{postMessage({type:t,err:n})})},n=>{postMessage({type:t,err:n})});break;case"init-ep":{let{epName:n,env:s}=e;ou(s,n).then(()=>{postMessage({type:t})},r=>{postMessage({type:t,err:r})});break}case"copy-from":{let{buffer:n}=e,s=ko(n);postMessage({type:t,out:s});break}case"create":{let{model:n,options:s}=e;lu(n,s).then(r=>{postMessage({type:t,out:r})},r=>{postMessage({type:t,err:r})});break}case"release":cu(e),postMessage({type:t});break;case"run":{let{sessionId:n,inputIndices:s,inputs:r,outputIndices:a,options:o}=e;hu(n,s,r,a,new Array(a.length).fill(null),o).then(l=>{l.some(c=>c[3]!=="cpu")?postMessage({type:t,err:"Proxy does not support non-cpu tensor location."}):postMessage({type:t,out:l},fu([...r,...l]))},l=>{postMessage({type:t,err:l})});break}case"end-profiling":uu(e),postMessage({type:t});break;default:}}catch(n){postMessage({type:t,err:n})}}),wp=Dh?null:i=>new Worker(i??Vn,{type:"module",name:Nh})}),bp={};zo(bp,{default:()=>Sp});var Oh,Sp,Gd,ay=de(()=>{"use strict";Oh=async function(i={}){var t,e,n=i,s=new Promise((v,R)=>{t=v,e=R}),r=typeof window=="object",a=typeof WorkerGlobalScope<"u",o=a&&self.name?.startsWith("em-pthread");n.mountExternalData=(v,R)=>{v.startsWith("./")&&(v=v.substring(2)),(n.Sa||(n.Sa=new Map)).set(v,R)},n.unmountExternalData=()=>{delete n.Sa};var l,c,h=globalThis.SharedArrayBuffer??new WebAssembly.Memory({initial:0,maximum:0,kb:!0}).buffer.constructor,u=(v,R)=>{throw R},f=studioAddress,d="";if(r||a){try{d=new URL(".",f).href}catch{}a&&(c=v=>{var R=new XMLHttpRequest;return R.open("GET",v,!1),R.responseType="arraybuffer",R.send(null),new Uint8Array(R.response)}),l=async v=>{if(Q(v))return new Promise((U,Y)=>{var K=new XMLHttpRequest;K.open("GET",v,!0),K.responseType="arraybuffer",K.onload=()=>{K.status==200||K.status==0&&K.response?U(K.response):Y(K.status)},K.onerror=Y,K.send(null)});var R=await fetch(v,{credentials:"same-origin"});if(R.ok)return R.arrayBuffer();throw Error(R.status+" : "+R.url)}}var p,_,m,g,x,w,M,E,T,y,A,F,N,D=console.log.bind(console),B=console.error.bind(console),Z=D,P=B,$=!1,Q=v=>v.startsWith("file://");function W(){return _.buffer!=x.buffer&&_t(),x}function at(){return _.buffer!=x.buffer&&_t(),w}function X(){return _.buffer!=x.buffer&&_t(),M}function z(){return _.buffer!=x.buffer&&_t(),E}function it(){return _.buffer!=x.buffer&&_t(),T}function Rt(){return _.buffer!=x.buffer&&_t(),y}function kt(){return _.buffer!=x.buffer&&_t(),F}if(o){let v=function(R){try{var U=R.data,Y=U.Ra;if(Y==="load"){let K=[];self.onmessage=vt=>K.push(vt),self.startWorker=()=>{postMessage({Ra:"loaded"});for(let vt of K)v(vt);self.onmessage=v};for(let vt of U.Za)n[vt]&&!n[vt].proxy||(n[vt]=(...Ht)=>{postMessage({Ra:"callHandler",Ya:vt,args:Ht})},vt=="print"&&(Z=n[vt]),vt=="printErr"&&(P=n[vt]));_=U.fb,_t(),N(U.gb)}else if(Y==="run"){C(U.Qa),Eh(U.Qa,0,0,1,0,0),Mt(),xs(U.Qa),pt||=!0;try{V(U.bb,U.Va)}catch(K){if(K!="unwind")throw K}}else U.target!=="setimmediate"&&(Y==="checkMailbox"?pt&&Js():Y&&(P(`worker: received unknown command ${Y}`),P(U)))}catch(K){throw Dd(),K}};var et=v,pt=!1;self.onunhandledrejection=R=>{throw R.reason||R},self.onmessage=v}function _t(){var v=_.buffer;n.HEAP8=x=new Int8Array(v),M=new Int16Array(v),n.HEAPU8=w=new Uint8Array(v),new Uint16Array(v),n.HEAP32=E=new Int32Array(v),n.HEAPU32=T=new Uint32Array(v),y=new Float32Array(v),F=new Float64Array(v),A=new BigInt64Array(v),new BigUint64Array(v)}function Nt(){o?startWorker(n):Xt.$()}var lt,Tt=0,oe=null;function Ft(){if(--Tt==0&&oe){var v=oe;oe=null,v()}}function ee(v){throw P(v="Aborted("+v+")"),$=!0,v=new WebAssembly.RuntimeError(v+". Build with -sASSERTIONS for more info."),e(v),v}function xe(){return{a:{j:Co,b:st,E:yt,f:I,U:nt,A:J,C:mt,V:ht,S:dt,L:Dt,R:Kt,n:ct,B:Ot,y:Zt,T:wt,z:me,_:Xe,O:yi,w:So,F:Ii,t:jr,i:Eo,N:xs,X:Ao,I:js,J:wh,K:To,G:ea,H:Ro,u:na,q:L,Z:H,o:Ct,k:xt,Y:q,d:bt,W:Lt,x:qt,c:bh,e:ne,h:Pt,v:ie,s:sn,r:It,P:Ke,Q:ai,D:pn,g:vi,m:ce,M:$e,l:Ie,a:_,p:Be}}}class Qt{name="ExitStatus";constructor(R){this.message=`Program terminated with exit(${R})`,this.status=R}}var We=v=>{v.terminate(),v.onmessage=()=>{}},Ue=[],fn=v=>{ze.length==0&&(Bt(),ke(ze[0]));var R=ze.pop();if(!R)return 6;O.push(R),pe[v.Qa]=R,R.Qa=v.Qa;var U={Ra:"run",bb:v.ab,Va:v.Va,Qa:v.Qa};return R.postMessage(U,v.Xa),0},ve=0,le=(v,R,...U)=>{for(var Y=2*U.length,K=Rh(),vt=Th(8*Y),Ht=vt>>>3,Fe=0;Fe<U.length;Fe++){var rn=U[Fe];typeof rn=="bigint"?(A[Ht+2*Fe]=1n,A[Ht+2*Fe+1]=rn):(A[Ht+2*Fe]=0n,kt()[Ht+2*Fe+1>>>0]=rn)}return v=Od(v,0,Y,vt,R),Po(K),v};function Be(v){if(o)return le(0,1,v);if(g=v,!(0<ve)){for(var R of O)We(R);for(R of ze)We(R);ze=[],O=[],pe={},$=!0}u(0,new Qt(v))}function bn(v){if(o)return le(1,0,v);pn(v)}var pn=v=>{if(g=v,o)throw bn(v),"unwind";Be(v)},ze=[],O=[],Sn=[],pe={},Te=v=>{var R=v.Qa;delete pe[R],ze.push(v),O.splice(O.indexOf(v),1),v.Qa=0,Ud(R)};function Mt(){Sn.forEach(v=>v())}var ke=v=>new Promise(R=>{v.onmessage=K=>{var vt=(K=K.data).Ra;if(K.Ta&&K.Ta!=Sh()){var Ht=pe[K.Ta];Ht?Ht.postMessage(K,K.Xa):P(`Internal error! Worker sent a message "${vt}" to target pthread ${K.Ta}, but that thread no longer exists!`)}else vt==="checkMailbox"?Js():vt==="spawnThread"?fn(K):vt==="cleanupThread"?Te(pe[K.cb]):vt==="loaded"?(v.loaded=!0,R(v)):K.target==="setimmediate"?v.postMessage(K):vt==="callHandler"?n[K.Ya](...K.args):vt&&P(`worker sent an unknown command ${vt}`)},v.onerror=K=>{throw P(`worker sent an error! ${K.filename}:${K.lineno}: ${K.message}`),K};var U,Y=[];for(U of[])n.propertyIsEnumerable(U)&&Y.push(U);v.postMessage({Ra:"load",Za:Y,fb:_,gb:m})});function Bt(){var v=new Worker((()=>{let R=URL;return studioAddress>"file:"&&studioAddress<"file;"?new R("ort.wasm.bundle.min.mjs",studioAddress):new URL(studioAddress)})(),{type:"module",workerData:"em-pthread",name:"em-pthread"});ze.push(v)}var Vt,C=v=>{_t();var R=it()[v+52>>>2>>>0];v=it()[v+56>>>2>>>0],kd(R,R-v),Po(R)},b=[],V=(v,R)=>{ve=0;var U=b[v];U||(b[v]=U=Vt.get(v)),v=U(R),0<ve?g=v:Ah(v)};class ot{constructor(R){this.Ua=R-24}}function st(v,R,U){var Y=new ot(v>>>=0);throw R>>>=0,U>>>=0,it()[Y.Ua+16>>>2>>>0]=0,it()[Y.Ua+4>>>2>>>0]=R,it()[Y.Ua+8>>>2>>>0]=U,v}function ut(v,R,U,Y){return o?le(2,1,v,R,U,Y):yt(v,R,U,Y)}function yt(v,R,U,Y){if(v>>>=0,U>>>=0,Y>>>=0,h===void 0)return 6;var K=[];return o&&K.length===0?ut(v,R>>>=0,U,Y):(v={ab:U,Qa:v,Va:Y,Xa:K},o?(v.Ra="spawnThread",postMessage(v,K),0):fn(v))}var j=typeof TextDecoder<"u"?new TextDecoder:void 0,tt=(v,R=0,U=NaN)=>{var Y=(R>>>=0)+U;for(U=R;v[U]&&!(U>=Y);)++U;if(16<U-R&&v.buffer&&j)return j.decode(v.buffer instanceof ArrayBuffer?v.subarray(R,U):v.slice(R,U));for(Y="";R<U;){var K=v[R++];if(128&K){var vt=63&v[R++];if((224&K)==192)Y+=String.fromCharCode((31&K)<<6|vt);else{var Ht=63&v[R++];65536>(K=(240&K)==224?(15&K)<<12|vt<<6|Ht:(7&K)<<18|vt<<12|Ht<<6|63&v[R++])?Y+=String.fromCharCode(K):(K-=65536,Y+=String.fromCharCode(55296|K>>10,56320|1023&K))}}else Y+=String.fromCharCode(K)}return Y},ft=(v,R)=>(v>>>=0)?tt(at(),v,R):"";function I(v,R,U){return o?le(3,1,v,R,U):0}function nt(v,R){if(o)return le(4,1,v,R)}function J(v,R){if(o)return le(5,1,v,R)}function mt(v,R,U){if(o)return le(6,1,v,R,U)}function ht(v,R,U){return o?le(7,1,v,R,U):0}function dt(v,R){if(o)return le(8,1,v,R)}function Dt(v,R,U){if(o)return le(9,1,v,R,U)}function Kt(v,R,U,Y){if(o)return le(10,1,v,R,U,Y)}function ct(v,R,U,Y){if(o)return le(11,1,v,R,U,Y)}function Ot(v,R,U,Y){if(o)return le(12,1,v,R,U,Y)}function Zt(v){if(o)return le(13,1,v)}function wt(v,R){if(o)return le(14,1,v,R)}function me(v,R,U){if(o)return le(15,1,v,R,U)}var Xe=()=>ee("");function yi(v){Eh(v>>>0,!a,1,!r,131072,!1),Mt()}var Kr=v=>{if(!$)try{if(v(),!(0<ve))try{o?Ah(g):pn(g)}catch(R){R instanceof Qt||R=="unwind"||u(0,R)}}catch(R){R instanceof Qt||R=="unwind"||u(0,R)}};function xs(v){v>>>=0,typeof Atomics.eb=="function"&&(Atomics.eb(z(),v>>>2,v).value.then(Js),v+=128,Atomics.store(z(),v>>>2,1))}var Js=()=>{var v=Sh();v&&(xs(v),Kr(Bd))};function So(v,R){(v>>>=0)==R>>>0?setTimeout(Js):o?postMessage({Ta:v,Ra:"checkMailbox"}):(v=pe[v])&&v.postMessage({Ra:"checkMailbox"})}var Ks=[];function Ii(v,R,U,Y,K){for(R>>>=0,Y/=2,Ks.length=Y,U=K>>>0>>>3,K=0;K<Y;K++)Ks[K]=A[U+2*K]?A[U+2*K+1]:kt()[U+2*K+1>>>0];return(R?Jn[R]:qe[v])(...Ks)}var jr=()=>{ve=0};function Eo(v){v>>>=0,o?postMessage({Ra:"cleanupThread",cb:v}):Te(pe[v])}function Ao(v){}function js(v,R){v=-9007199254740992>v||9007199254740992<v?NaN:Number(v),R>>>=0,v=new Date(1e3*v),z()[R>>>2>>>0]=v.getUTCSeconds(),z()[R+4>>>2>>>0]=v.getUTCMinutes(),z()[R+8>>>2>>>0]=v.getUTCHours(),z()[R+12>>>2>>>0]=v.getUTCDate(),z()[R+16>>>2>>>0]=v.getUTCMonth(),z()[R+20>>>2>>>0]=v.getUTCFullYear()-1900,z()[R+24>>>2>>>0]=v.getUTCDay(),v=(v.getTime()-Date.UTC(v.getUTCFullYear(),0,1,0,0,0,0))/864e5|0,z()[R+28>>>2>>>0]=v}var Qr=v=>v%4==0&&(v%100!=0||v%400==0),ta=[0,31,60,91,121,152,182,213,244,274,305,335],Ki=[0,31,59,90,120,151,181,212,243,273,304,334];function wh(v,R){v=-9007199254740992>v||9007199254740992<v?NaN:Number(v),R>>>=0,v=new Date(1e3*v),z()[R>>>2>>>0]=v.getSeconds(),z()[R+4>>>2>>>0]=v.getMinutes(),z()[R+8>>>2>>>0]=v.getHours(),z()[R+12>>>2>>>0]=v.getDate(),z()[R+16>>>2>>>0]=v.getMonth(),z()[R+20>>>2>>>0]=v.getFullYear()-1900,z()[R+24>>>2>>>0]=v.getDay();var U=(Qr(v.getFullYear())?ta:Ki)[v.getMonth()]+v.getDate()-1|0;z()[R+28>>>2>>>0]=U,z()[R+36>>>2>>>0]=-60*v.getTimezoneOffset(),U=new Date(v.getFullYear(),6,1).getTimezoneOffset();var Y=new Date(v.getFullYear(),0,1).getTimezoneOffset();v=0|(U!=Y&&v.getTimezoneOffset()==Math.min(Y,U)),z()[R+32>>>2>>>0]=v}function To(v){v>>>=0;var R=new Date(z()[v+20>>>2>>>0]+1900,z()[v+16>>>2>>>0],z()[v+12>>>2>>>0],z()[v+8>>>2>>>0],z()[v+4>>>2>>>0],z()[v>>>2>>>0],0),U=z()[v+32>>>2>>>0],Y=R.getTimezoneOffset(),K=new Date(R.getFullYear(),6,1).getTimezoneOffset(),vt=new Date(R.getFullYear(),0,1).getTimezoneOffset(),Ht=Math.min(vt,K);return 0>U?z()[v+32>>>2>>>0]=+(K!=vt&&Ht==Y):0<U!=(Ht==Y)&&(K=Math.max(vt,K),R.setTime(R.getTime()+6e4*((0<U?Ht:K)-Y))),z()[v+24>>>2>>>0]=R.getDay(),U=(Qr(R.getFullYear())?ta:Ki)[R.getMonth()]+R.getDate()-1|0,z()[v+28>>>2>>>0]=U,z()[v>>>2>>>0]=R.getSeconds(),z()[v+4>>>2>>>0]=R.getMinutes(),z()[v+8>>>2>>>0]=R.getHours(),z()[v+12>>>2>>>0]=R.getDate(),z()[v+16>>>2>>>0]=R.getMonth(),z()[v+20>>>2>>>0]=R.getYear(),v=R.getTime(),BigInt(isNaN(v)?-1:v/1e3)}function ea(v,R,U,Y,K,vt,Ht){return o?le(16,1,v,R,U,Y,K,vt,Ht):-52}function Ro(v,R,U,Y,K,vt){if(o)return le(17,1,v,R,U,Y,K,vt)}var vs={},bh=()=>performance.timeOrigin+performance.now();function na(v,R){if(o)return le(18,1,v,R);if(vs[v]&&(clearTimeout(vs[v].id),delete vs[v]),!R)return 0;var U=setTimeout(()=>{delete vs[v],Kr(()=>Fd(v,performance.timeOrigin+performance.now()))},R);return vs[v]={id:U,lb:R},0}var S=(v,R,U)=>{var Y=at();if(R>>>=0,0<U){var K=R;U=R+U-1;for(var vt=0;vt<v.length;++vt){var Ht=v.charCodeAt(vt);if(55296<=Ht&&57343>=Ht&&(Ht=65536+((1023&Ht)<<10)|1023&v.charCodeAt(++vt)),127>=Ht){if(R>=U)break;Y[R++>>>0]=Ht}else{if(2047>=Ht){if(R+1>=U)break;Y[R++>>>0]=192|Ht>>6}else{if(65535>=Ht){if(R+2>=U)break;Y[R++>>>0]=224|Ht>>12}else{if(R+3>=U)break;Y[R++>>>0]=240|Ht>>18,Y[R++>>>0]=128|Ht>>12&63}Y[R++>>>0]=128|Ht>>6&63}Y[R++>>>0]=128|63&Ht}}Y[R>>>0]=0,v=R-K}else v=0;return v};function L(v,R,U,Y){v>>>=0,R>>>=0,U>>>=0,Y>>>=0;var K=new Date().getFullYear(),vt=new Date(K,0,1).getTimezoneOffset();K=new Date(K,6,1).getTimezoneOffset();var Ht=Math.max(vt,K);it()[v>>>2>>>0]=60*Ht,z()[R>>>2>>>0]=+(vt!=K),v=(R=Fe=>{var rn=Math.abs(Fe);return`UTC${0<=Fe?"-":"+"}${String(Math.floor(rn/60)).padStart(2,"0")}${String(rn%60).padStart(2,"0")}`})(vt),R=R(K),K<vt?(S(v,U,17),S(R,Y,17)):(S(v,Y,17),S(R,U,17))}var q=()=>Date.now(),G=1;function H(v,R,U){if(!(0<=v&&3>=v))return 28;if(v===0)v=Date.now();else{if(!G)return 52;v=performance.timeOrigin+performance.now()}return A[U>>>0>>>3]=BigInt(Math.round(1e6*v)),0}var gt=[];function Ct(v,R,U){v>>>=0,R>>>=0,U>>>=0,gt.length=0;for(var Y;Y=at()[R++>>>0];){var K=Y!=105;U+=(K&=Y!=112)&&U%8?4:0,gt.push(Y==112?it()[U>>>2>>>0]:Y==106?A[U>>>3]:Y==105?z()[U>>>2>>>0]:kt()[U>>>3>>>0]),U+=K?8:4}return Jn[v](...gt)}var xt=()=>{};function bt(v,R){return P(ft(v>>>0,R>>>0))}var Lt=()=>{throw ve+=1,"unwind"};function qt(){return 4294901760}var ne=()=>navigator.hardwareConcurrency;function Pt(){return ee("Cannot use emscripten_pc_get_function without -sUSE_OFFSET_CONVERTER"),0}function ie(v){v>>>=0;var R=at().length;if(v<=R||4294901760<v)return!1;for(var U=1;4>=U;U*=2){var Y=R*(1+.2/U);Y=Math.min(Y,v+100663296);t:{Y=(Math.min(4294901760,65536*Math.ceil(Math.max(v,Y)/65536))-_.buffer.byteLength+65535)/65536|0;try{_.grow(Y),_t();var K=1;break t}catch{}K=void 0}if(K)return!0}return!1}var Ne=()=>(ee("Cannot use convertFrameToPC (needed by __builtin_return_address) without -sUSE_OFFSET_CONVERTER"),0),fe={},Me=v=>{v.forEach(R=>{var U=Ne();U&&(fe[U]=R)})};function sn(){var v=Error().stack.toString().split(`
`);return v[0]=="Error"&&v.shift(),Me(v),fe.Wa=Ne(),fe.$a=v,fe.Wa}function It(v,R,U){if(v>>>=0,R>>>=0,fe.Wa==v)var Y=fe.$a;else(Y=Error().stack.toString().split(`
`))[0]=="Error"&&Y.shift(),Me(Y);for(var K=3;Y[K]&&Ne()!=v;)++K;for(v=0;v<U&&Y[v+K];++v)z()[R+4*v>>>2>>>0]=Ne();return v}var Je,ue={},xi=()=>{if(!Je){var v,R={USER:"web_user",LOGNAME:"web_user",PATH:"/",PWD:"/",HOME:"/home/web_user",LANG:(typeof navigator=="object"&&navigator.languages&&navigator.languages[0]||"C").replace("-","_")+".UTF-8",_:"./this.program"};for(v in ue)ue[v]===void 0?delete R[v]:R[v]=ue[v];var U=[];for(v in R)U.push(`${v}=${R[v]}`);Je=U}return Je};function Ke(v,R){if(o)return le(19,1,v,R);v>>>=0,R>>>=0;var U,Y=0,K=0;for(U of xi()){var vt=R+Y;it()[v+K>>>2>>>0]=vt,Y+=S(U,vt,1/0)+1,K+=4}return 0}var Ms=v=>{for(var R=0,U=0;U<v.length;++U){var Y=v.charCodeAt(U);127>=Y?R++:2047>=Y?R+=2:55296<=Y&&57343>=Y?(R+=4,++U):R+=3}return R};function ai(v,R){if(o)return le(20,1,v,R);v>>>=0,R>>>=0;var U=xi();for(var Y of(it()[v>>>2>>>0]=U.length,v=0,U))v+=Ms(Y)+1;return it()[R>>>2>>>0]=v,0}function vi(v){return o?le(21,1,v):52}function ce(v,R,U,Y){return o?le(22,1,v,R,U,Y):52}function $e(v,R,U,Y){return o?le(23,1,v,R,U,Y):70}var Gn=[null,[],[]];function Ie(v,R,U,Y){if(o)return le(24,1,v,R,U,Y);R>>>=0,U>>>=0,Y>>>=0;for(var K=0,vt=0;vt<U;vt++){var Ht=it()[R>>>2>>>0],Fe=it()[R+4>>>2>>>0];R+=8;for(var rn=0;rn<Fe;rn++){var mn=v,ia=at()[Ht+rn>>>0],Ch=Gn[mn];ia===0||ia===10?((mn===1?Z:P)(tt(Ch)),Ch.length=0):Ch.push(ia)}K+=Fe}return it()[Y>>>2>>>0]=K,0}o||(function(){for(var v=n.numThreads-1;v--;)Bt();Ue.push(()=>{Tt++,(function(R){o?R():Promise.all(ze.map(ke)).then(R)})(()=>Ft())})})(),o||(_=new WebAssembly.Memory({initial:256,maximum:65536,shared:!0}),_t()),n.wasmBinary&&(p=n.wasmBinary),n.stackSave=()=>Rh(),n.stackRestore=v=>Po(v),n.stackAlloc=v=>Th(v),n.setValue=function(v,R,U="i8"){switch(U.endsWith("*")&&(U="*"),U){case"i1":case"i8":W()[v>>>0]=R;break;case"i16":X()[v>>>1>>>0]=R;break;case"i32":z()[v>>>2>>>0]=R;break;case"i64":A[v>>>3]=BigInt(R);break;case"float":Rt()[v>>>2>>>0]=R;break;case"double":kt()[v>>>3>>>0]=R;break;case"*":it()[v>>>2>>>0]=R;break;default:ee(`invalid type for setValue: ${U}`)}},n.getValue=function(v,R="i8"){switch(R.endsWith("*")&&(R="*"),R){case"i1":case"i8":return W()[v>>>0];case"i16":return X()[v>>>1>>>0];case"i32":return z()[v>>>2>>>0];case"i64":return A[v>>>3];case"float":return Rt()[v>>>2>>>0];case"double":return kt()[v>>>3>>>0];case"*":return it()[v>>>2>>>0];default:ee(`invalid type for getValue: ${R}`)}},n.UTF8ToString=ft,n.stringToUTF8=S,n.lengthBytesUTF8=Ms;var qe=[Be,bn,ut,I,nt,J,mt,ht,dt,Dt,Kt,ct,Ot,Zt,wt,me,ea,Ro,na,Ke,ai,vi,ce,$e,Ie],Jn={853836:(v,R,U,Y,K)=>{if(n===void 0||!n.Sa)return 1;if((v=ft(Number(v>>>0))).startsWith("./")&&(v=v.substring(2)),!(v=n.Sa.get(v)))return 2;if(R=Number(R>>>0),U=Number(U>>>0),Y=Number(Y>>>0),R+U>v.byteLength)return 3;try{let vt=v.subarray(R,R+U);switch(K){case 0:at().set(vt,Y>>>0);break;case 1:n.hb?n.hb(Y,vt):n.jb(Y,vt);break;default:return 4}return 0}catch{return 4}},854660:()=>typeof wasmOffsetConverter<"u"};function Co(){return typeof wasmOffsetConverter<"u"}var Xt=await(async function(){function v(Y,K){return Xt=Y.exports,Xt=(function(){var vt=Xt,Ht=rn=>()=>rn()>>>0,Fe=rn=>mn=>rn(mn)>>>0;return(vt=Object.assign({},vt)).Aa=Ht(vt.Aa),vt.Ca=Fe(vt.Ca),vt.Oa=Fe(vt.Oa),vt.Pa=Ht(vt.Pa),vt.__cxa_get_exception_ptr=Fe(vt.__cxa_get_exception_ptr),vt})(),Sn.push(Xt.Da),Vt=Xt.Ea,m=K,Ft(),Xt}Tt++;var R=xe();if(n.instantiateWasm)return new Promise(Y=>{n.instantiateWasm(R,(K,vt)=>{Y(v(K,vt))})});if(o)return new Promise(Y=>{N=K=>{var vt=new WebAssembly.Instance(K,xe());Y(v(vt,K))}});lt??=n.locateFile?n.locateFile?n.locateFile("ort-wasm-simd-threaded.wasm",d):d+"ort-wasm-simd-threaded.wasm":new URL("ort-wasm-simd-threaded.wasm",studioAddress).href;try{var U=await(async function(Y){var K=lt;if(!p&&typeof WebAssembly.instantiateStreaming=="function"&&!Q(K))try{var vt=fetch(K,{credentials:"same-origin"});return await WebAssembly.instantiateStreaming(vt,Y)}catch(Ht){P(`wasm streaming compile failed: ${Ht}`),P("falling back to ArrayBuffer instantiation")}return(async function(Ht,Fe){try{var rn=await(async function(mn){if(!p)try{var ia=await l(mn);return new Uint8Array(ia)}catch{}if(mn==lt&&p)mn=new Uint8Array(p);else{if(!c)throw"both async and sync fetching of the wasm failed";mn=c(mn)}return mn})(Ht);return await WebAssembly.instantiate(rn,Fe)}catch(mn){P(`failed to asynchronously prepare wasm: ${mn}`),ee(mn)}})(K,Y)})(R);return v(U.instance,U.module)}catch(Y){return e(Y),Promise.reject(Y)}})();n._OrtInit=(v,R)=>(n._OrtInit=Xt.aa)(v,R),n._OrtGetLastError=(v,R)=>(n._OrtGetLastError=Xt.ba)(v,R),n._OrtCreateSessionOptions=(v,R,U,Y,K,vt,Ht,Fe,rn,mn)=>(n._OrtCreateSessionOptions=Xt.ca)(v,R,U,Y,K,vt,Ht,Fe,rn,mn),n._OrtAppendExecutionProvider=(v,R,U,Y,K)=>(n._OrtAppendExecutionProvider=Xt.da)(v,R,U,Y,K),n._OrtAddFreeDimensionOverride=(v,R,U)=>(n._OrtAddFreeDimensionOverride=Xt.ea)(v,R,U),n._OrtAddSessionConfigEntry=(v,R,U)=>(n._OrtAddSessionConfigEntry=Xt.fa)(v,R,U),n._OrtReleaseSessionOptions=v=>(n._OrtReleaseSessionOptions=Xt.ga)(v),n._OrtCreateSession=(v,R,U)=>(n._OrtCreateSession=Xt.ha)(v,R,U),n._OrtReleaseSession=v=>(n._OrtReleaseSession=Xt.ia)(v),n._OrtGetInputOutputCount=(v,R,U)=>(n._OrtGetInputOutputCount=Xt.ja)(v,R,U),n._OrtGetInputOutputMetadata=(v,R,U,Y)=>(n._OrtGetInputOutputMetadata=Xt.ka)(v,R,U,Y),n._OrtFree=v=>(n._OrtFree=Xt.la)(v),n._OrtCreateTensor=(v,R,U,Y,K,vt)=>(n._OrtCreateTensor=Xt.ma)(v,R,U,Y,K,vt),n._OrtGetTensorData=(v,R,U,Y,K)=>(n._OrtGetTensorData=Xt.na)(v,R,U,Y,K),n._OrtReleaseTensor=v=>(n._OrtReleaseTensor=Xt.oa)(v),n._OrtCreateRunOptions=(v,R,U,Y)=>(n._OrtCreateRunOptions=Xt.pa)(v,R,U,Y),n._OrtAddRunConfigEntry=(v,R,U)=>(n._OrtAddRunConfigEntry=Xt.qa)(v,R,U),n._OrtReleaseRunOptions=v=>(n._OrtReleaseRunOptions=Xt.ra)(v),n._OrtCreateBinding=v=>(n._OrtCreateBinding=Xt.sa)(v),n._OrtBindInput=(v,R,U)=>(n._OrtBindInput=Xt.ta)(v,R,U),n._OrtBindOutput=(v,R,U,Y)=>(n._OrtBindOutput=Xt.ua)(v,R,U,Y),n._OrtClearBoundOutputs=v=>(n._OrtClearBoundOutputs=Xt.va)(v),n._OrtReleaseBinding=v=>(n._OrtReleaseBinding=Xt.wa)(v),n._OrtRunWithBinding=(v,R,U,Y,K)=>(n._OrtRunWithBinding=Xt.xa)(v,R,U,Y,K),n._OrtRun=(v,R,U,Y,K,vt,Ht,Fe)=>(n._OrtRun=Xt.ya)(v,R,U,Y,K,vt,Ht,Fe),n._OrtEndProfiling=v=>(n._OrtEndProfiling=Xt.za)(v);var Sh=()=>(Sh=Xt.Aa)();n._free=v=>(n._free=Xt.Ba)(v),n._malloc=v=>(n._malloc=Xt.Ca)(v);var Eh=(v,R,U,Y,K,vt)=>(Eh=Xt.Fa)(v,R,U,Y,K,vt),Dd=()=>(Dd=Xt.Ga)(),Od=(v,R,U,Y,K)=>(Od=Xt.Ha)(v,R,U,Y,K),Ud=v=>(Ud=Xt.Ia)(v),Ah=v=>(Ah=Xt.Ja)(v),Fd=(v,R)=>(Fd=Xt.Ka)(v,R),Bd=()=>(Bd=Xt.La)(),kd=(v,R)=>(kd=Xt.Ma)(v,R),Po=v=>(Po=Xt.Na)(v),Th=v=>(Th=Xt.Oa)(v),Rh=()=>(Rh=Xt.Pa)();return(function v(){if(0<Tt)oe=v;else if(o)t(n),Nt();else{for(;0<Ue.length;)Ue.shift()(n);0<Tt?oe=v:(n.calledRun=!0,$||(Nt(),t(n)))}})(),n.PTR_SIZE=4,s},Sp=Oh,Gd=globalThis.self?.name?.startsWith("em-pthread"),Gd&&Oh()}),Uh,Yh,Vd,Vn,Ep,Lo,Hd,Wd,Fh,Xd,Bh,Ap,kh,Tp,tu=de(()=>{"use strict";Qh(),Uh=typeof location>"u"?void 0:studioOrigin,Yh=studioAddress>"file:"&&studioAddress<"file;",Vd=()=>{if(Yh){let i=URL;return new URL(new i("ort.wasm.bundle.min.mjs",studioAddress).href,Uh).href}return studioAddress},Vn=Vd(),Ep=()=>{if(Vn&&!Vn.startsWith("blob:"))return Vn.substring(0,Vn.lastIndexOf("/")+1)},Lo=(i,t)=>{try{let e=t??Vn;return(e?new URL(i,e):new URL(i)).origin===Uh}catch{return!1}},Hd=(i,t)=>{let e=t??Vn;try{return(e?new URL(i,e):new URL(i)).href}catch{return}},Wd=(i,t)=>`${t??"./"}${i}`,Fh=async i=>{let t=await(await fetch(i,{credentials:"same-origin"})).blob();return URL.createObjectURL(t)},Xd=async i=>(await import(i)).default,Bh=(ry(),$h(Mp)).default,Ap=async()=>{if(!Vn)throw new Error("Failed to load proxy worker: cannot determine the script source URL.");if(Lo(Vn))return[void 0,Bh()];let i=await Fh(Vn);return[i,Bh(i)]},kh=(ay(),$h(bp)).default,Tp=async(i,t,e,n)=>{let s=kh&&!(i||t);if(s)if(Vn)s=Lo(Vn);else if(n&&!e)s=!0;else throw new Error("cannot determine the script source URL.");if(s)return[void 0,kh];{let r="ort-wasm-simd-threaded.mjs",a=i??Hd(r,t),o=e&&a&&!Lo(a,t),l=o?await Fh(a):a??Wd(r,t);return[o?l:void 0,await Xd(l)]}}}),zh,No,ra,Gh,$d,qd,Yd,eu,De,ar=de(()=>{"use strict";tu(),No=!1,ra=!1,Gh=!1,$d=()=>{if(typeof SharedArrayBuffer>"u")return!1;try{return typeof MessageChannel<"u"&&new MessageChannel().port1.postMessage(new SharedArrayBuffer(1)),WebAssembly.validate(new Uint8Array([0,97,115,109,1,0,0,0,1,4,1,96,0,0,3,2,1,0,5,4,1,3,1,1,10,11,1,9,0,65,0,254,16,2,0,26,11]))}catch{return!1}},qd=()=>{try{return WebAssembly.validate(new Uint8Array([0,97,115,109,1,0,0,0,1,4,1,96,0,0,3,2,1,0,10,30,1,28,0,65,0,253,15,253,12,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,253,186,1,26,11]))}catch{return!1}},Yd=()=>{try{return WebAssembly.validate(new Uint8Array([0,97,115,109,1,0,0,0,1,5,1,96,0,1,123,3,2,1,0,10,19,1,17,0,65,1,253,15,65,2,253,15,65,3,253,15,253,147,2,11]))}catch{return!1}},eu=async i=>{if(No)return Promise.resolve();if(ra)throw new Error("multiple calls to 'initializeWebAssembly()' detected.");if(Gh)throw new Error("previous call to 'initializeWebAssembly()' failed.");ra=!0;let t=i.initTimeout,e=i.numThreads;if(i.simd!==!1){if(i.simd==="relaxed"){if(!Yd())throw new Error("Relaxed WebAssembly SIMD is not supported in the current environment.")}else if(!qd())throw new Error("WebAssembly SIMD is not supported in the current environment.")}let n=$d();e>1&&!n&&(typeof self<"u"&&!self.crossOriginIsolated&&console.warn("env.wasm.numThreads is set to "+e+", but this will not work unless you enable crossOriginIsolated mode. See https://web.dev/cross-origin-isolation-guide/ for more info."),console.warn("WebAssembly multi-threading is not supported in the current environment. Falling back to single-threading."),i.numThreads=e=1);let s=i.wasmPaths,r=typeof s=="string"?s:void 0,a=s?.mjs,o=a?.href??a,l=s?.wasm,c=l?.href??l,h=i.wasmBinary,[u,f]=await Tp(o,r,e>1,!!h||!!c),d=!1,p=[];if(t>0&&p.push(new Promise(_=>{setTimeout(()=>{d=!0,_()},t)})),p.push(new Promise((_,m)=>{let g={numThreads:e};if(h)g.wasmBinary=h;else if(c||r)g.locateFile=x=>c??r+x;else if(o&&o.indexOf("blob:")!==0)g.locateFile=x=>new URL(x,o).href;else if(u){let x=Ep();x&&(g.locateFile=w=>x+w)}f(g).then(x=>{ra=!1,No=!0,zh=x,_(),u&&URL.revokeObjectURL(u)},x=>{ra=!1,Gh=!0,m(x)})})),await Promise.race(p),d)throw new Error(`WebAssembly backend initializing failed due to timeout: ${t}ms`)},De=()=>{if(No&&zh)return zh;throw new Error("WebAssembly is not initialized yet.")}}),oi,Bo,Re,nu=de(()=>{"use strict";ar(),oi=(i,t)=>{let e=De(),n=e.lengthBytesUTF8(i)+1,s=e._malloc(n);return e.stringToUTF8(i,s,n),t.push(s),s},Bo=(i,t,e,n)=>{if(typeof i=="object"&&i!==null){if(e.has(i))throw new Error("Circular reference in options");e.add(i)}Object.entries(i).forEach(([s,r])=>{let a=t?t+s:s;if(typeof r=="object")Bo(r,a+".",e,n);else if(typeof r=="string"||typeof r=="number")n(a,r.toString());else if(typeof r=="boolean")n(a,r?"1":"0");else throw new Error(`Can't handle extra config type: ${typeof r}`)})},Re=i=>{let t=De(),e=t.stackSave();try{let n=t.PTR_SIZE,s=t.stackAlloc(2*n);t._OrtGetLastError(s,s+n);let r=Number(t.getValue(s,n===4?"i32":"i64")),a=t.getValue(s+n,"*"),o=a?t.UTF8ToString(a):"";throw new Error(`${i} ERROR_CODE: ${r}, ERROR_MESSAGE: ${o}`)}finally{t.stackRestore(e)}}}),Rp,oy=de(()=>{"use strict";ar(),nu(),Rp=i=>{let t=De(),e=0,n=[],s=i||{};try{if(i?.logSeverityLevel===void 0)s.logSeverityLevel=2;else if(typeof i.logSeverityLevel!="number"||!Number.isInteger(i.logSeverityLevel)||i.logSeverityLevel<0||i.logSeverityLevel>4)throw new Error(`log severity level is not valid: ${i.logSeverityLevel}`);if(i?.logVerbosityLevel===void 0)s.logVerbosityLevel=0;else if(typeof i.logVerbosityLevel!="number"||!Number.isInteger(i.logVerbosityLevel))throw new Error(`log verbosity level is not valid: ${i.logVerbosityLevel}`);i?.terminate===void 0&&(s.terminate=!1);let r=0;return i?.tag!==void 0&&(r=oi(i.tag,n)),e=t._OrtCreateRunOptions(s.logSeverityLevel,s.logVerbosityLevel,!!s.terminate,r),e===0&&Re("Can't create run options."),i?.extra!==void 0&&Bo(i.extra,"",new WeakSet,(a,o)=>{let l=oi(a,n),c=oi(o,n);t._OrtAddRunConfigEntry(e,l,c)!==0&&Re(`Can't set a run config entry: ${a} - ${o}.`)}),[e,n]}catch(r){throw e!==0&&t._OrtReleaseRunOptions(e),n.forEach(a=>t._free(a)),r}}}),Zd,Jd,Kd,aa,jd,Cp,ly=de(()=>{"use strict";ar(),nu(),Zd=i=>{switch(i){case"disabled":return 0;case"basic":return 1;case"extended":return 2;case"layout":return 3;case"all":return 99;default:throw new Error(`unsupported graph optimization level: ${i}`)}},Jd=i=>{switch(i){case"sequential":return 0;case"parallel":return 1;default:throw new Error(`unsupported execution mode: ${i}`)}},Kd=i=>{i.extra||(i.extra={}),i.extra.session||(i.extra.session={});let t=i.extra.session;t.use_ort_model_bytes_directly||(t.use_ort_model_bytes_directly="1"),i.executionProviders&&i.executionProviders.some(e=>(typeof e=="string"?e:e.name)==="webgpu")&&(i.enableMemPattern=!1)},aa=(i,t,e,n)=>{let s=oi(t,n),r=oi(e,n);De()._OrtAddSessionConfigEntry(i,s,r)!==0&&Re(`Can't set a session config entry: ${t} - ${e}.`)},jd=async(i,t,e)=>{for(let n of t){let s=typeof n=="string"?n:n.name,r=[];switch(s){case"webnn":if(s="WEBNN",typeof n!="string"){let h=n?.deviceType;h&&aa(i,"deviceType",h,e)}break;case"webgpu":if(s="JS",typeof n!="string"){let h=n;if(h?.preferredLayout){if(h.preferredLayout!=="NCHW"&&h.preferredLayout!=="NHWC")throw new Error(`preferredLayout must be either 'NCHW' or 'NHWC': ${h.preferredLayout}`);aa(i,"preferredLayout",h.preferredLayout,e)}}break;case"wasm":case"cpu":continue;default:throw new Error(`not supported execution provider: ${s}`)}let a=oi(s,e),o=r.length,l=0,c=0;if(o>0){l=De()._malloc(o*De().PTR_SIZE),e.push(l),c=De()._malloc(o*De().PTR_SIZE),e.push(c);for(let h=0;h<o;h++)De().setValue(l+h*De().PTR_SIZE,r[h][0],"*"),De().setValue(c+h*De().PTR_SIZE,r[h][1],"*")}await De()._OrtAppendExecutionProvider(i,a,l,c,o)!==0&&Re(`Can't append execution provider: ${s}.`)}},Cp=async i=>{let t=De(),e=0,n=[],s=i||{};Kd(s);try{let r=Zd(s.graphOptimizationLevel??"all"),a=Jd(s.executionMode??"sequential"),o=typeof s.logId=="string"?oi(s.logId,n):0,l=s.logSeverityLevel??2;if(!Number.isInteger(l)||l<0||l>4)throw new Error(`log severity level is not valid: ${l}`);let c=s.logVerbosityLevel??0;if(!Number.isInteger(c)||c<0||c>4)throw new Error(`log verbosity level is not valid: ${c}`);let h=typeof s.optimizedModelFilePath=="string"?oi(s.optimizedModelFilePath,n):0;if(e=t._OrtCreateSessionOptions(r,!!s.enableCpuMemArena,!!s.enableMemPattern,a,!!s.enableProfiling,0,o,l,c,h),e===0&&Re("Can't create session options."),s.executionProviders&&await jd(e,s.executionProviders,n),s.enableGraphCapture!==void 0){if(typeof s.enableGraphCapture!="boolean")throw new Error(`enableGraphCapture must be a boolean value: ${s.enableGraphCapture}`);aa(e,"enableGraphCapture",s.enableGraphCapture.toString(),n)}if(s.freeDimensionOverrides)for(let[u,f]of Object.entries(s.freeDimensionOverrides)){if(typeof u!="string")throw new Error(`free dimension override name must be a string: ${u}`);if(typeof f!="number"||!Number.isInteger(f)||f<0)throw new Error(`free dimension override value must be a non-negative integer: ${f}`);let d=oi(u,n);t._OrtAddFreeDimensionOverride(e,d,f)!==0&&Re(`Can't set a free dimension override: ${u} - ${f}.`)}return s.extra!==void 0&&Bo(s.extra,"",new WeakSet,(u,f)=>{aa(e,u,f,n)}),[e,n]}catch(r){throw e!==0&&t._OrtReleaseSessionOptions(e)!==0&&Re("Can't release session options."),n.forEach(a=>t._free(a)),r}}}),tr,Uo,er,Pp,Ip,iu,su,Lp,Np=de(()=>{"use strict";tr=i=>{switch(i){case"int8":return 3;case"uint8":return 2;case"bool":return 9;case"int16":return 5;case"uint16":return 4;case"int32":return 6;case"uint32":return 12;case"float16":return 10;case"float32":return 1;case"float64":return 11;case"string":return 8;case"int64":return 7;case"uint64":return 13;case"int4":return 22;case"uint4":return 21;default:throw new Error(`unsupported data type: ${i}`)}},Uo=i=>{switch(i){case 3:return"int8";case 2:return"uint8";case 9:return"bool";case 5:return"int16";case 4:return"uint16";case 6:return"int32";case 12:return"uint32";case 10:return"float16";case 1:return"float32";case 11:return"float64";case 8:return"string";case 7:return"int64";case 13:return"uint64";case 22:return"int4";case 21:return"uint4";default:throw new Error(`unsupported data type: ${i}`)}},er=(i,t)=>{let e=[-1,4,1,1,2,2,4,8,-1,1,2,8,4,8,-1,-1,-1,-1,-1,-1,-1,.5,.5][i],n=typeof t=="number"?t:t.reduce((s,r)=>s*r,1);return e>0?Math.ceil(n*e):void 0},Pp=i=>{switch(i){case"float16":return typeof Float16Array<"u"&&Float16Array.from?Float16Array:Uint16Array;case"float32":return Float32Array;case"uint8":return Uint8Array;case"int8":return Int8Array;case"uint16":return Uint16Array;case"int16":return Int16Array;case"int32":return Int32Array;case"bool":return Uint8Array;case"float64":return Float64Array;case"uint32":return Uint32Array;case"int64":return BigInt64Array;case"uint64":return BigUint64Array;default:throw new Error(`unsupported type: ${i}`)}},Ip=i=>{switch(i){case"verbose":return 0;case"info":return 1;case"warning":return 2;case"error":return 3;case"fatal":return 4;default:throw new Error(`unsupported logging level: ${i}`)}},iu=i=>i==="float32"||i==="float16"||i==="int32"||i==="int64"||i==="uint32"||i==="uint8"||i==="bool"||i==="uint4"||i==="int4",su=i=>i==="float32"||i==="float16"||i==="int32"||i==="int64"||i==="uint32"||i==="uint64"||i==="int8"||i==="uint8"||i==="bool"||i==="uint4"||i==="int4",Lp=i=>{switch(i){case"none":return 0;case"cpu":return 1;case"cpu-pinned":return 2;case"texture":return 3;case"gpu-buffer":return 4;case"ml-tensor":return 5;default:throw new Error(`unsupported data location: ${i}`)}}}),ru,Dp=de(()=>{"use strict";Qh(),ru=async i=>{if(typeof i=="string"){let t=await fetch(i);if(!t.ok)throw new Error(`failed to load external data file: ${i}`);let e=t.headers.get("Content-Length"),n=e?parseInt(e,10):0;if(n<1073741824)return new Uint8Array(await t.arrayBuffer());{if(!t.body)throw new Error(`failed to load external data file: ${i}, no response body.`);let s=t.body.getReader(),r;try{r=new ArrayBuffer(n)}catch(o){if(o instanceof RangeError){let l=Math.ceil(n/65536);r=new WebAssembly.Memory({initial:l,maximum:l}).buffer}else throw o}let a=0;for(;;){let{done:o,value:l}=await s.read();if(o)break;let c=l.byteLength;new Uint8Array(r,a,c).set(l),a+=c}return new Uint8Array(r,0,n)}}else return i instanceof Blob?new Uint8Array(await i.arrayBuffer()):i instanceof Uint8Array?i:new Uint8Array(i)}}),Qd,au,ou,bs,tp,Vh,ko,lu,cu,Hh,hu,uu,fu,Op=de(()=>{"use strict";Ts(),oy(),ly(),Np(),ar(),nu(),Dp(),Qd=(i,t)=>{De()._OrtInit(i,t)!==0&&Re("Can't initialize onnxruntime.")},au=async i=>{Qd(i.wasm.numThreads,Ip(i.logLevel))},ou=async(i,t)=>{De().asyncInit?.();let e=i.webgpu.adapter;if(t==="webgpu"){if(typeof navigator>"u"||!navigator.gpu)throw new Error("WebGPU is not supported in current environment");if(e){if(typeof e.limits!="object"||typeof e.features!="object"||typeof e.requestDevice!="function")throw new Error("Invalid GPU adapter set in `env.webgpu.adapter`. It must be a GPUAdapter object.")}else{let n=i.webgpu.powerPreference;if(n!==void 0&&n!=="low-power"&&n!=="high-performance")throw new Error(`Invalid powerPreference setting: "${n}"`);let s=i.webgpu.forceFallbackAdapter;if(s!==void 0&&typeof s!="boolean")throw new Error(`Invalid forceFallbackAdapter setting: "${s}"`);if(e=await navigator.gpu.requestAdapter({powerPreference:n,forceFallbackAdapter:s}),!e)throw new Error('Failed to get GPU adapter. You may need to enable flag "--enable-unsafe-webgpu" if you are using Chrome.')}}if(t==="webnn"&&(typeof navigator>"u"||!navigator.ml))throw new Error("WebNN is not supported in current environment")},bs=new Map,tp=i=>{let t=De(),e=t.stackSave();try{let n=t.PTR_SIZE,s=t.stackAlloc(2*n);t._OrtGetInputOutputCount(i,s,s+n)!==0&&Re("Can't get session input/output count.");let r=n===4?"i32":"i64";return[Number(t.getValue(s,r)),Number(t.getValue(s+n,r))]}finally{t.stackRestore(e)}},Vh=(i,t)=>{let e=De(),n=e.stackSave(),s=0;try{let r=e.PTR_SIZE,a=e.stackAlloc(2*r);e._OrtGetInputOutputMetadata(i,t,a,a+r)!==0&&Re("Can't get session input/output metadata.");let o=Number(e.getValue(a,"*"));s=Number(e.getValue(a+r,"*"));let l=e.HEAP32[s/4];if(l===0)return[o,0];let c=e.HEAPU32[s/4+1],h=[];for(let u=0;u<c;u++){let f=Number(e.getValue(s+8+u*r,"*"));h.push(f!==0?e.UTF8ToString(f):Number(e.getValue(s+8+(u+c)*r,"*")))}return[o,l,h]}finally{e.stackRestore(n),s!==0&&e._OrtFree(s)}},ko=i=>{let t=De(),e=t._malloc(i.byteLength);if(e===0)throw new Error(`Can't create a session. failed to allocate a buffer of size ${i.byteLength}.`);return t.HEAPU8.set(i,e),[e,i.byteLength]},lu=async(i,t)=>{let e,n,s=De();Array.isArray(i)?[e,n]=i:i.buffer===s.HEAPU8.buffer?[e,n]=[i.byteOffset,i.byteLength]:[e,n]=ko(i);let r=0,a=0,o=0,l=[],c=[],h=[];try{if([a,l]=await Cp(t),t?.externalData&&s.mountExternalData){let w=[];for(let M of t.externalData){let E=typeof M=="string"?M:M.path;w.push(ru(typeof M=="string"?M:M.data).then(T=>{s.mountExternalData(E,T)}))}await Promise.all(w)}for(let w of t?.executionProviders??[])if((typeof w=="string"?w:w.name)==="webnn"){if(s.shouldTransferToMLTensor=!1,typeof w!="string"){let M=w,E=M?.context,T=M?.gpuDevice,y=M?.deviceType,A=M?.powerPreference;E?s.currentContext=E:T?s.currentContext=await s.webnnCreateMLContext(T):s.currentContext=await s.webnnCreateMLContext({deviceType:y,powerPreference:A})}else s.currentContext=await s.webnnCreateMLContext();break}r=await s._OrtCreateSession(e,n,a),s.webgpuOnCreateSession?.(r),r===0&&Re("Can't create a session."),s.jsepOnCreateSession?.(),s.currentContext&&(s.webnnRegisterMLContext(r,s.currentContext),s.currentContext=void 0,s.shouldTransferToMLTensor=!0);let[u,f]=tp(r),d=!!t?.enableGraphCapture,p=[],_=[],m=[],g=[],x=[];for(let w=0;w<u;w++){let[M,E,T]=Vh(r,w);M===0&&Re("Can't get an input name."),c.push(M);let y=s.UTF8ToString(M);p.push(y),m.push(E===0?{name:y,isTensor:!1}:{name:y,isTensor:!0,type:Uo(E),shape:T})}for(let w=0;w<f;w++){let[M,E,T]=Vh(r,w+u);M===0&&Re("Can't get an output name."),h.push(M);let y=s.UTF8ToString(M);_.push(y),g.push(E===0?{name:y,isTensor:!1}:{name:y,isTensor:!0,type:Uo(E),shape:T})}return bs.set(r,[r,c,h,null,d,!1]),[r,p,_,m,g]}catch(u){throw c.forEach(f=>s._OrtFree(f)),h.forEach(f=>s._OrtFree(f)),o!==0&&s._OrtReleaseBinding(o)!==0&&Re("Can't release IO binding."),r!==0&&s._OrtReleaseSession(r)!==0&&Re("Can't release session."),u}finally{s._free(e),a!==0&&s._OrtReleaseSessionOptions(a)!==0&&Re("Can't release session options."),l.forEach(u=>s._free(u)),s.unmountExternalData?.()}},cu=i=>{let t=De(),e=bs.get(i);if(!e)throw new Error(`cannot release session. invalid session id: ${i}`);let[n,s,r,a,o]=e;a&&(o&&t._OrtClearBoundOutputs(a.handle)!==0&&Re("Can't clear bound outputs."),t._OrtReleaseBinding(a.handle)!==0&&Re("Can't release IO binding.")),t.jsepOnReleaseSession?.(i),t.webnnOnReleaseSession?.(i),t.webgpuOnReleaseSession?.(i),s.forEach(l=>t._OrtFree(l)),r.forEach(l=>t._OrtFree(l)),t._OrtReleaseSession(n)!==0&&Re("Can't release session."),bs.delete(i)},Hh=async(i,t,e,n,s,r,a=!1)=>{if(!i){t.push(0);return}let o=De(),l=o.PTR_SIZE,c=i[0],h=i[1],u=i[3],f=u,d,p;if(c==="string"&&(u==="gpu-buffer"||u==="ml-tensor"))throw new Error("String tensor is not supported on GPU.");if(a&&u!=="gpu-buffer")throw new Error(`External buffer must be provided for input/output index ${r} when enableGraphCapture is true.`);if(u==="gpu-buffer"){let g=i[2].gpuBuffer;p=er(tr(c),h);{let x=o.jsepRegisterBuffer;if(!x)throw new Error('Tensor location "gpu-buffer" is not supported without using WebGPU.');d=x(n,r,g,p)}}else if(u==="ml-tensor"){let g=i[2].mlTensor;p=er(tr(c),h);let x=o.webnnRegisterMLTensor;if(!x)throw new Error('Tensor location "ml-tensor" is not supported without using WebNN.');d=x(n,g,tr(c),h)}else{let g=i[2];if(Array.isArray(g)){p=l*g.length,d=o._malloc(p),e.push(d);for(let x=0;x<g.length;x++){if(typeof g[x]!="string")throw new TypeError(`tensor data at index ${x} is not a string`);o.setValue(d+x*l,oi(g[x],e),"*")}}else{let x=o.webnnIsGraphInput,w=o.webnnIsGraphOutput;if(c!=="string"&&x&&w){let M=o.UTF8ToString(s);if(x(n,M)||w(n,M)){let E=tr(c);p=er(E,h),f="ml-tensor";let T=o.webnnCreateTemporaryTensor,y=o.webnnUploadTensor;if(!T||!y)throw new Error('Tensor location "ml-tensor" is not supported without using WebNN.');let A=await T(n,E,h);y(A,new Uint8Array(g.buffer,g.byteOffset,g.byteLength)),d=A}else p=g.byteLength,d=o._malloc(p),e.push(d),o.HEAPU8.set(new Uint8Array(g.buffer,g.byteOffset,p),d)}else p=g.byteLength,d=o._malloc(p),e.push(d),o.HEAPU8.set(new Uint8Array(g.buffer,g.byteOffset,p),d)}}let _=o.stackSave(),m=o.stackAlloc(4*h.length);try{h.forEach((x,w)=>o.setValue(m+w*l,x,l===4?"i32":"i64"));let g=o._OrtCreateTensor(tr(c),d,p,m,h.length,Lp(f));g===0&&Re(`Can't create tensor for input/output. session=${n}, index=${r}.`),t.push(g)}finally{o.stackRestore(_)}},hu=async(i,t,e,n,s,r)=>{let a=De(),o=a.PTR_SIZE,l=bs.get(i);if(!l)throw new Error(`cannot run inference. invalid session id: ${i}`);let c=l[0],h=l[1],u=l[2],f=l[3],d=l[4],p=l[5],_=t.length,m=n.length,g=0,x=[],w=[],M=[],E=[],T=a.stackSave(),y=a.stackAlloc(_*o),A=a.stackAlloc(_*o),F=a.stackAlloc(m*o),N=a.stackAlloc(m*o);try{[g,x]=Rp(r),sr("wasm prepareInputOutputTensor");for(let P=0;P<_;P++)await Hh(e[P],w,E,i,h[t[P]],t[P],d);for(let P=0;P<m;P++)await Hh(s[P],M,E,i,u[n[P]],_+n[P],d);rr("wasm prepareInputOutputTensor");for(let P=0;P<_;P++)a.setValue(y+P*o,w[P],"*"),a.setValue(A+P*o,h[t[P]],"*");for(let P=0;P<m;P++)a.setValue(F+P*o,M[P],"*"),a.setValue(N+P*o,u[n[P]],"*");a.jsepOnRunStart?.(c),a.webnnOnRunStart?.(c);let D;D=await a._OrtRun(c,A,y,_,N,m,F,g),D!==0&&Re("failed to call OrtRun().");let B=[],Z=[];sr("wasm ProcessOutputTensor");for(let P=0;P<m;P++){let $=Number(a.getValue(F+P*o,"*"));if($===M[P]){B.push(s[P]);continue}let Q=a.stackSave(),W=a.stackAlloc(4*o),at=!1,X,z=0;try{a._OrtGetTensorData($,W,W+o,W+2*o,W+3*o)!==0&&Re(`Can't access output tensor data on index ${P}.`);let it=o===4?"i32":"i64",Rt=Number(a.getValue(W,it));z=a.getValue(W+o,"*");let kt=a.getValue(W+o*2,"*"),et=Number(a.getValue(W+o*3,it)),pt=[];for(let lt=0;lt<et;lt++)pt.push(Number(a.getValue(kt+lt*o,it)));a._OrtFree(kt)!==0&&Re("Can't free memory for tensor dims.");let _t=pt.reduce((lt,Tt)=>lt*Tt,1);X=Uo(Rt);let Nt=f?.outputPreferredLocations[n[P]];if(X==="string"){if(Nt==="gpu-buffer"||Nt==="ml-tensor")throw new Error("String tensor is not supported on GPU.");let lt=[];for(let Tt=0;Tt<_t;Tt++){let oe=a.getValue(z+Tt*o,"*"),Ft=a.getValue(z+(Tt+1)*o,"*"),ee=Tt===_t-1?void 0:Ft-oe;lt.push(a.UTF8ToString(oe,ee))}B.push([X,pt,lt,"cpu"])}else if(Nt==="gpu-buffer"&&_t>0){let lt=a.jsepGetBuffer;if(!lt)throw new Error('preferredLocation "gpu-buffer" is not supported without using WebGPU.');let Tt=lt(z),oe=er(Rt,_t);if(oe===void 0||!iu(X))throw new Error(`Unsupported data type: ${X}`);at=!0,B.push([X,pt,{gpuBuffer:Tt,download:a.jsepCreateDownloader(Tt,oe,X),dispose:()=>{a._OrtReleaseTensor($)!==0&&Re("Can't release tensor.")}},"gpu-buffer"])}else if(Nt==="ml-tensor"&&_t>0){let lt=a.webnnEnsureTensor,Tt=a.webnnIsGraphInputOutputTypeSupported;if(!lt||!Tt)throw new Error('preferredLocation "ml-tensor" is not supported without using WebNN.');if(er(Rt,_t)===void 0||!su(X))throw new Error(`Unsupported data type: ${X}`);if(!Tt(i,X,!1))throw new Error(`preferredLocation "ml-tensor" for ${X} output is not supported by current WebNN Context.`);let oe=await lt(i,z,Rt,pt,!1);at=!0,B.push([X,pt,{mlTensor:oe,download:a.webnnCreateMLTensorDownloader(z,X),dispose:()=>{a.webnnReleaseTensorId(z),a._OrtReleaseTensor($)}},"ml-tensor"])}else if(Nt==="ml-tensor-cpu-output"&&_t>0){let lt=a.webnnCreateMLTensorDownloader(z,X)(),Tt=B.length;at=!0,Z.push((async()=>{let oe=[Tt,await lt];return a.webnnReleaseTensorId(z),a._OrtReleaseTensor($),oe})()),B.push([X,pt,[],"cpu"])}else{let lt=Pp(X),Tt=new lt(_t);new Uint8Array(Tt.buffer,Tt.byteOffset,Tt.byteLength).set(a.HEAPU8.subarray(z,z+Tt.byteLength)),B.push([X,pt,Tt,"cpu"])}}finally{a.stackRestore(Q),X==="string"&&z&&a._free(z),at||a._OrtReleaseTensor($)}}f&&!d&&(a._OrtClearBoundOutputs(f.handle)!==0&&Re("Can't clear bound outputs."),bs.set(i,[c,h,u,f,d,!1]));for(let[P,$]of await Promise.all(Z))B[P][2]=$;return rr("wasm ProcessOutputTensor"),B}finally{a.webnnOnRunEnd?.(c),a.stackRestore(T),w.forEach(D=>a._OrtReleaseTensor(D)),M.forEach(D=>a._OrtReleaseTensor(D)),E.forEach(D=>a._free(D)),g!==0&&a._OrtReleaseRunOptions(g),x.forEach(D=>a._free(D))}},uu=i=>{let t=De(),e=bs.get(i);if(!e)throw new Error("invalid session id");let n=e[0],s=t._OrtEndProfiling(n);s===0&&Re("Can't get an profile file name."),t._OrtFree(s)},fu=i=>{let t=[];for(let e of i){let n=e[2];!Array.isArray(n)&&"buffer"in n&&t.push(n.buffer)}return t}}),Qi,Kn,Qs,oa,la,Do,Wh,Oo,Ss,Es,ep,Up,Fp,Bp,kp,zp,Gp,Vp,Hp=de(()=>{"use strict";Ts(),Op(),ar(),tu(),Qi=()=>!!Ce.wasm.proxy&&typeof document<"u",Qs=!1,oa=!1,la=!1,Oo=new Map,Ss=(i,t)=>{let e=Oo.get(i);e?e.push(t):Oo.set(i,[t])},Es=()=>{if(Qs||!oa||la||!Kn)throw new Error("worker not ready")},ep=i=>{switch(i.data.type){case"init-wasm":Qs=!1,i.data.err?(la=!0,Wh[1](i.data.err)):(oa=!0,Wh[0]()),Do&&(URL.revokeObjectURL(Do),Do=void 0);break;case"init-ep":case"copy-from":case"create":case"release":case"run":case"end-profiling":{let t=Oo.get(i.data.type);i.data.err?t.shift()[1](i.data.err):t.shift()[0](i.data.out);break}default:}},Up=async()=>{if(!oa){if(Qs)throw new Error("multiple calls to 'initWasm()' detected.");if(la)throw new Error("previous call to 'initWasm()' failed.");if(Qs=!0,Qi())return new Promise((i,t)=>{Kn?.terminate(),Ap().then(([e,n])=>{try{Kn=n,Kn.onerror=r=>t(r),Kn.onmessage=ep,Wh=[i,t];let s={type:"init-wasm",in:Ce};!s.in.wasm.wasmPaths&&(e||Yh)&&(s.in.wasm.wasmPaths={wasm:new URL("ort-wasm-simd-threaded.wasm",studioAddress).href}),Kn.postMessage(s),Do=e}catch(s){t(s)}},t)});try{await eu(Ce.wasm),await au(Ce),oa=!0}catch(i){throw la=!0,i}finally{Qs=!1}}},Fp=async i=>{if(Qi())return Es(),new Promise((t,e)=>{Ss("init-ep",[t,e]);let n={type:"init-ep",in:{epName:i,env:Ce}};Kn.postMessage(n)});await ou(Ce,i)},Bp=async i=>Qi()?(Es(),new Promise((t,e)=>{Ss("copy-from",[t,e]);let n={type:"copy-from",in:{buffer:i}};Kn.postMessage(n,[i.buffer])})):ko(i),kp=async(i,t)=>{if(Qi()){if(t?.preferredOutputLocation)throw new Error('session option "preferredOutputLocation" is not supported for proxy.');return Es(),new Promise((e,n)=>{Ss("create",[e,n]);let s={type:"create",in:{model:i,options:{...t}}},r=[];i instanceof Uint8Array&&r.push(i.buffer),Kn.postMessage(s,r)})}else return lu(i,t)},zp=async i=>{if(Qi())return Es(),new Promise((t,e)=>{Ss("release",[t,e]);let n={type:"release",in:i};Kn.postMessage(n)});cu(i)},Gp=async(i,t,e,n,s,r)=>{if(Qi()){if(e.some(a=>a[3]!=="cpu"))throw new Error("input tensor on GPU is not supported for proxy.");if(s.some(a=>a))throw new Error("pre-allocated output tensor is not supported for proxy.");return Es(),new Promise((a,o)=>{Ss("run",[a,o]);let l=e,c={type:"run",in:{sessionId:i,inputIndices:t,inputs:l,outputIndices:n,options:r}};Kn.postMessage(c,fu(l))})}else return hu(i,t,e,n,s,r)},Vp=async i=>{if(Qi())return Es(),new Promise((t,e)=>{Ss("end-profiling",[t,e]);let n={type:"end-profiling",in:i};Kn.postMessage(n)});uu(i)}}),Xh,np,Wp,cy=de(()=>{"use strict";Ts(),Hp(),Np(),Qh(),Dp(),Xh=(i,t)=>{switch(i.location){case"cpu":return[i.type,i.dims,i.data,"cpu"];case"gpu-buffer":return[i.type,i.dims,{gpuBuffer:i.gpuBuffer},"gpu-buffer"];case"ml-tensor":return[i.type,i.dims,{mlTensor:i.mlTensor},"ml-tensor"];default:throw new Error(`invalid data location: ${i.location} for ${t()}`)}},np=i=>{switch(i[3]){case"cpu":return new on(i[0],i[2],i[1]);case"gpu-buffer":{let t=i[0];if(!iu(t))throw new Error(`not supported data type: ${t} for deserializing GPU tensor`);let{gpuBuffer:e,download:n,dispose:s}=i[2];return on.fromGpuBuffer(e,{dataType:t,dims:i[1],download:n,dispose:s})}case"ml-tensor":{let t=i[0];if(!su(t))throw new Error(`not supported data type: ${t} for deserializing MLTensor tensor`);let{mlTensor:e,download:n,dispose:s}=i[2];return on.fromMLTensor(e,{dataType:t,dims:i[1],download:n,dispose:s})}default:throw new Error(`invalid data location: ${i[3]}`)}},Wp=class{async fetchModelAndCopyToWasmMemory(i){return Bp(await ru(i))}async loadModel(i,t){nr();let e;typeof i=="string"?e=await this.fetchModelAndCopyToWasmMemory(i):e=i,[this.sessionId,this.inputNames,this.outputNames,this.inputMetadata,this.outputMetadata]=await kp(e,t),ir()}async dispose(){return zp(this.sessionId)}async run(i,t,e){nr();let n=[],s=[];Object.entries(i).forEach(u=>{let f=u[0],d=u[1],p=this.inputNames.indexOf(f);if(p===-1)throw new Error(`invalid input '${f}'`);n.push(d),s.push(p)});let r=[],a=[];Object.entries(t).forEach(u=>{let f=u[0],d=u[1],p=this.outputNames.indexOf(f);if(p===-1)throw new Error(`invalid output '${f}'`);r.push(d),a.push(p)});let o=n.map((u,f)=>Xh(u,()=>`input "${this.inputNames[s[f]]}"`)),l=r.map((u,f)=>u?Xh(u,()=>`output "${this.outputNames[a[f]]}"`):null),c=await Gp(this.sessionId,s,o,a,l,e),h={};for(let u=0;u<c.length;u++)h[this.outputNames[a[u]]]=r[u]??np(c[u]);return ir(),h}startProfiling(){}endProfiling(){Vp(this.sessionId)}}}),Xp={};zo(Xp,{OnnxruntimeWebAssemblyBackend:()=>Jh,initializeFlags:()=>Zh,wasmBackend:()=>$p});var Zh,Jh,$p,hy=de(()=>{"use strict";Ts(),Hp(),cy(),Zh=()=>{(typeof Ce.wasm.initTimeout!="number"||Ce.wasm.initTimeout<0)&&(Ce.wasm.initTimeout=0);let i=Ce.wasm.simd;if(typeof i!="boolean"&&i!==void 0&&i!=="fixed"&&i!=="relaxed"&&(console.warn(`Property "env.wasm.simd" is set to unknown value "${i}". Reset it to \`false\` and ignore SIMD feature checking.`),Ce.wasm.simd=!1),typeof Ce.wasm.proxy!="boolean"&&(Ce.wasm.proxy=!1),typeof Ce.wasm.trace!="boolean"&&(Ce.wasm.trace=!1),typeof Ce.wasm.numThreads!="number"||!Number.isInteger(Ce.wasm.numThreads)||Ce.wasm.numThreads<=0)if(typeof self<"u"&&!self.crossOriginIsolated)Ce.wasm.numThreads=1;else{let t=typeof navigator>"u"?H_("node:os").cpus().length:navigator.hardwareConcurrency;Ce.wasm.numThreads=Math.min(4,Math.ceil((t||1)/2))}},Jh=class{async init(i){Zh(),await Up(),await Fp(i)}async createInferenceSessionHandler(i,t){let e=new Wp;return await e.loadModel(i,t),e}},$p=new Jh});Ts();Ts();Ts();var uy="1.23.2";{let i=(hy(),$h(Xp)).wasmBackend;Fo("cpu",i,10),Fo("wasm",i,10)}Object.defineProperty(Ce.versions,"web",{value:uy,enumerable:!0});var Rs=class{constructor(t){let e=new DataView(t.buffer,t.byteOffset,t.byteLength),n=Number(e.getBigUint64(0,!0));this.entries=JSON.parse(new TextDecoder().decode(t.subarray(8,8+n))),this.data=t.subarray(8+n)}has(t){return t in this.entries}shape(t){return this.entries[t].shape}raw(t,e){let[n,s]=this.entries[t].data_offsets;return new e(this.data.slice(n,s).buffer)}scales(t){return this.floats(`${t}.int8_scale`)}adapter(t){let e=Object.keys(this.entries).filter(l=>qp.test(l)).sort(),n=(l,c,h)=>l.replace(qp,`.adapters.${c}.${h}.weight`),s=0;for(let l=0;this.has(n(e[0],l,0));l++)s=Math.max(s,this.shape(n(e[0],l,0))[0]);let r=e.map(l=>[this.shape(l)[1],this.shape(n(l,0,1))[0]]),a=new Float32Array(s*r.flat().reduce((l,c)=>l+c,0)),o=0;return e.forEach((l,c)=>{let[h,u]=r[c],f=n(l,t,0),d=n(l,t,1),p=this.shape(f)[0];a.set(this.floats(f),o),o+=s*h;let _=this.floats(d);for(let m=0;m<u;m++,o+=s)a.set(_.subarray(m*p,(m+1)*p),o)}),a}floats(t){let{dtype:e}=this.entries[t];if(e==="F32")return this.raw(t,Float32Array);if(e==="F16")return Float32Array.from(this.raw(t,Uint16Array),py);if(e!=="I8")throw new Error(`${t} is stored as ${e}`);let n=this.scales(t),s=Float32Array.from(this.raw(t,Int8Array)),r=s.length/n.length;for(let a=0,o=0;a<n.length;a++)for(let l=o+r;o<l;o++)s[o]*=n[a];return s}ready(t,e=null){let n=t.replace(dy,""),s=this.floats(n);if(e&&this.change(n,s,e),n===t)return s;let[r,a]=this.shape(n),o=new Float32Array(s.length);for(let l=0,c=0;l<r;l++)for(let h=0;h<a;h++)o[h*r+l]=s[c++];return o}change(t,e,n){let s=t.replace(/^denoiser\./,"").replaceAll(".","_"),r=`${Vo}down.${s}`;if(this.has(r)){let l=this.floats(r),c=this.floats(`${Vo}up.${s}`),[h,u]=this.shape(r);for(let f=0;f*u<e.length;f++){let d=e.subarray(f*u,(f+1)*u);for(let p=0;p<h;p++){let _=c[f*h+p],m=l.subarray(p*u,(p+1)*u);for(let g=0;g<u;g++)d[g]+=_*m[g]}}return}if(!n.includes(t))return;this.shifts??=this.floats(`${Vo}shifts`);let a=this.shape(`${Vo}shifts`)[1],o=0;for(let l of n.slice(0,n.indexOf(t)))o+=Math.ceil(this.shape(l)[0]/a)*a;for(let l=0;l<e.length;l++)e[l]+=this.shifts[o+l]}},dy=/\/turned$/,Vo="denoiser.one_step.",qp=/\.adapters\.0\.0\.weight$/;function py(i){let t=i>>15?-1:1,e=i>>10&31,n=i&1023;return e===0?t*n*2**-24:t*(1+n/1024)*2**(e-15)}var or=class{constructor(t,e,n=[]){Ce.wasm.numThreads=1,Ce.wasm.wasmBinary=t.wasm.buffer,Ce.logLevel="error",Object.assign(this,{parts:t,names:e,shifted:n,weights:new Rs(t.weights)}),this.sessions={},this.adapters={},this.helper=null}session(t,e=!1){let n=e?`${t} first`:t;return this.sessions[n]??=Go.create(this.parts[t],{externalData:this.names[t].map(s=>({path:s,data:new Uint8Array(this.weights.ready(s,e?this.shifted:null).buffer)})),graphOptimizationLevel:"disabled"}).catch(s=>{throw delete this.sessions[n],s}),this.sessions[n]}adapter(t,e){let n=`${t} ${e}`;if(!this.adapters[n]){let s=this.weights.adapter(t-1);this.adapters[n]=new on("float32",Ho(Array(e).fill(s)),[e,s.length])}return this.adapters[n]}async predict(t,e,n,s,r,a=0,o=!1){if(this.helper&&t.length>1){let p=t.length>>1,_=[t.slice(p),e,n.slice(p),s,r,a,o],m=this.helper(..._).catch(()=>null),g=await this.predict(t.slice(0,p),e,n.slice(0,p),s,r,a,o),x=await m;return x===null&&(this.helper=null,x=await this.predict(..._)),[...g,...x]}let l=t.length,c=t[0].length,h=c/138,u=[l,h,23,6],f=a&&{adapter:this.adapter(a,l)},{prediction:d}=await(await this.session(a?"adapted":"graph",o)).run({x:new on("float32",Ho(t),u),t:new on("int64",new BigInt64Array(l).fill(BigInt(e)),[l]),pooled:new on("float32",Ho(n),[l,n[0].length]),tag:new on("int64",new BigInt64Array(l).fill(BigInt(s)),[l]),mask:new on("bool",new Uint8Array(l*h).fill(1),[l,h]),known:new on("bool",Ho(t.map(()=>r),Uint8Array),u),...f});return t.map((p,_)=>d.data.slice(_*c,(_+1)*c))}};function Ho(i,t=Float32Array){let e=new t(i.length*i[0].length);return i.forEach((n,s)=>e.set(n,s*n.length)),e}var li=(i,t)=>i[0]*t[0]+i[1]*t[1]+i[2]*t[2],jt=i=>Math.hypot(i[0],i[1],i[2]),Ee=(i,t)=>[i[0]+t[0],i[1]+t[1],i[2]+t[2]],Pe=(i,t)=>[i[0]-t[0],i[1]-t[1],i[2]-t[2]],Le=(i,t)=>[i[0]*t,i[1]*t,i[2]*t],Li=(i,t)=>[i[1]*t[2]-i[2]*t[1],i[2]*t[0]-i[0]*t[2],i[0]*t[1]-i[1]*t[0]],Ge=(i,t=1e-12)=>Le(i,1/Math.max(jt(i),t)),jn=(i,t,e)=>Math.min(Math.max(i,t),e),be=(i,t)=>{let e=new Array(9);for(let n=0;n<9;n+=3)for(let s=0;s<3;s++)e[n+s]=i[n]*t[s]+i[n+1]*t[3+s]+i[n+2]*t[6+s];return e},ci=i=>[i[0],i[3],i[6],i[1],i[4],i[7],i[2],i[5],i[8]],Ye=(i,t)=>[i[0]*t[0]+i[1]*t[1]+i[2]*t[2],i[3]*t[0]+i[4]*t[1]+i[5]*t[2],i[6]*t[0]+i[7]*t[1]+i[8]*t[2]];function Cs(i,t=0){let e=[i[t],i[t+1],i[t+2]],n=[i[t+3],i[t+4],i[t+5]];jt(e)>1e-6||(e=[1,0,0]);let s=Ge(e,1e-6),r=Pe(n,Le(s,li(s,n)));if(jt(r)<=1e-6*(1+jt(n))){let o=s.map(Math.abs),l=[0,0,0];l[o.indexOf(Math.min(...o))]=1,r=Pe(l,Le(s,li(s,l)))}r=Ge(r,1e-6);let a=Li(s,r);return[s[0],r[0],a[0],s[1],r[1],a[1],s[2],r[2],a[2]]}function ua(i,t,e){t.set([i[0],i[3],i[6],i[1],i[4],i[7]],e)}function gn(i){let t=[1+i[0]+i[4]+i[8],1+i[0]-i[4]-i[8],1-i[0]+i[4]-i[8],1-i[0]-i[4]+i[8]],[e,n,s]=[i[7]-i[5],i[2]-i[6],i[3]-i[1]],[r,a,o]=[i[3]+i[1],i[2]+i[6],i[7]+i[5]],c=[[t[0],e,n,s],[e,t[1],r,a],[n,r,t[2],o],[s,a,o,t[3]]][t.indexOf(Math.max(...t))],h=Math.hypot(...c)*(c[0]<0?-1:1);return c.map(u=>u/h)}function je(i,t=0){let e=Math.max(Math.hypot(i[t],i[t+1],i[t+2],i[t+3]),1e-12),[n,s,r,a]=[i[t]/e,i[t+1]/e,i[t+2]/e,i[t+3]/e];return[1-2*(r*r+a*a),2*(s*r-n*a),2*(s*a+n*r),2*(s*r+n*a),1-2*(s*s+a*a),2*(r*a-n*s),2*(s*a-n*r),2*(r*a+n*s),1-2*(s*s+r*r)]}var ha=(i,t)=>[i[0]*t[0]-i[1]*t[1]-i[2]*t[2]-i[3]*t[3],i[0]*t[1]+i[1]*t[0]+i[2]*t[3]-i[3]*t[2],i[0]*t[2]-i[1]*t[3]+i[2]*t[0]+i[3]*t[1],i[0]*t[3]+i[1]*t[2]-i[2]*t[1]+i[3]*t[0]],du=i=>[i[0],-i[1],-i[2],-i[3]];function Wo(i){let t=i[0]<0?-1:1,e=Math.hypot(i[1],i[2],i[3]),n=e>1e-6?2*Math.atan2(e,t*i[0])/e:2;return[t*i[1]*n,t*i[2]*n,t*i[3]*n]}function lr(i){let t=jt(i),e=t>1e-6?Math.sin(t/2)/t:.5;return[Math.cos(t/2),i[0]*e,i[1]*e,i[2]*e]}var Ni=(i,t,e)=>ha(i,lr(Le(Wo(ha(du(i),t)),e)));function Dn(i,t){for(let e=0;e<t;e+=4)for(let n=e;n<i.length;n+=t){let s=n-t;if((s<0?i[n]:i[n]*i[s]+i[n+1]*i[s+1]+i[n+2]*i[s+2]+i[n+3]*i[s+3])<0)for(let a=0;a<4;a++)i[n+a]=-i[n+a]}return i}function fa(i){let[t,e]=[Math.cos(i),Math.sin(i)];return[t,0,e,0,1,0,-e,0,t]}function pu([i,t,e],n){let[s,r]=[Math.cos(n),Math.sin(n)];return[s*i+r*e,t,s*e-r*i]}var da=(i,t)=>je(lr(Le(i,t)));function Yp(i,t){let[e,n]=[Ge(i),Ge(t)],s=Li(e,n);return da(Ge(s),Math.atan2(jt(s),li(e,n)))}function Xo(i){let t=gn(i);return 2*Math.atan2(t[2],t[0])}function Ps(i){let t=0;for(let e=1,n=i[0];e<i.length;e++){let s=i[e]-n;n=i[e];let r=((s+Math.PI)%(2*Math.PI)+2*Math.PI)%(2*Math.PI)-Math.PI;r===-Math.PI&&s>0&&(r=Math.PI),Math.abs(s)>=Math.PI&&(t+=r-s),i[e]+=t}return i}var $t=22,St=30,_e={names:[],parents:[],offsets:[]},Ae={},Qn,Is,pa,ma,hi,ga,_a;function $o({names:i,parents:t,offsets:e,tips:n,limbs:s,groups:r}){Object.assign(_e,{names:i,parents:t,offsets:e,tips:n}),i.forEach((a,o)=>{Ae[a]=o}),[hi,ga]=["leg","arm"].map(a=>["left","right"].map(o=>s[`${o}-${a}`].map(l=>Ae[l]))),ma=hi.map(([,,a,o])=>({ankle:a,ball:o})),_a=r,Qn=.02,Is=Qn-hi[0].reduce((a,o)=>a+e[o][1],0),pa=-e[hi[0][1]][1]-e[hi[0][2]][1]}function my(i,t){let{parents:e,offsets:n}=_e,s=[i[0]],r=[t];for(let a=1;a<$t;a++){let o=e[a];s.push(be(s[o],i[a])),r.push(Ee(r[o],Ye(s[o],n[a])))}return{positions:r,world:s}}function En(i,t){let e=[];for(let n=0;n<$t;n++)e.push(je(i.quaternions,(t*$t+n)*4));return my(e,Array.from(i.root.subarray(t*3,t*3+3)))}var gy=23,At=gy*6,ae=132,[_n,An,ya,Ve,cr]=[0,1,2,3,4],hr={x:0,z:0,heading:0},ge=i=>i.length/At,He=(i,t,e)=>i.slice(t*At,e*At);function mu(i,t,e=0,n=ge(i)){for(let s of t){let r=0;for(let a=e;a<n;a++)r+=i[a*At+ae+s];for(let a=e;a<n;a++)i[a*At+ae+s]-=r/(n-e)}}function gu(i,t){if(t===1)return i;let e=new Float32Array(Math.ceil(ge(i)/t)*At);for(let n=0;n*At<e.length;n++){e.set(He(i,n*t,n*t+1),n*At);for(let s=n*t+1;s<Math.min((n+1)*t,ge(i));s++)for(let r of[_n,An,Ve])e[n*At+ae+r]+=i[s*At+ae+r]}return e}function On(i,t=Float32Array){let e=new t(i.reduce((s,r)=>s+r.length,0)),n=0;for(let s of i)e.set(s,n),n+=s.length;return e}function qo(i,t=hr,e=St,n=(r,a)=>i[r*At+ae+a],s=ge(i)){let r=new Float64Array(s*3),a=new Float64Array(s),{x:o,z:l,heading:c}=t;for(let h=0;h<s;h++){r.set([o,n(h,ya),l],h*3),a[h]=c;let[u,f]=[Math.sin(c),Math.cos(c)],[d,p]=[n(h,_n),n(h,An)];o+=(d*u+p*f)/e,l+=(d*f-p*u)/e,c+=n(h,Ve)/e}return{path:r,heading:a,end:{x:o,z:l,heading:c}}}function ts(i,t=hr,e="",n=St){let s=ge(i),{path:r,heading:a}=qo(i,t,n),o=new Float32Array(s*$t*4),l=new Float32Array(s*2);for(let c=0;c<s;c++){for(let h=0;h<$t;h++){let u=Cs(i,c*At+h*6);h===0&&(u=be(fa(a[c]),u)),o.set(gn(u),(c*$t+h)*4)}for(let h of[0,1])l[c*2+h]=jn(i[c*At+ae+cr+h],0,1)}return Dn(o,$t*4),{frames:s,quaternions:o,root:Float32Array.from(r),contacts:l,fps:n,text:e}}function ur(i){let t=new Float64Array(i.frames);for(let e=0;e<i.frames;e++)t[e]=Xo(je(i.quaternions,e*$t*4));return Ps(t)}function fr(i,t){return{x:i.root[t*3],z:i.root[t*3+2],heading:ur(i)[t]}}function _u(i){let{frames:t,fps:e}=i,n=new Float32Array(t*At),s=ur(i);for(let r=0;r<t;r++){let a=fa(-s[r]);for(let d=0;d<$t;d++){let p=je(i.quaternions,(r*$t+d)*4);ua(d===0?be(a,p):p,n,r*At+d*6)}let o=r*At+ae,l=Math.max(Math.min(r,t-2),0),c=t<2?[0,0,0]:[0,1,2].map(d=>(i.root[(l+1)*3+d]-i.root[l*3+d])*e),[h,,u]=Ye(a,c),f=t<2?0:(s[l+1]-s[l])*e;n.set([u,h,i.root[r*3+1],f,i.contacts[r*2],i.contacts[r*2+1]],o)}return n}function Tn(i,t,e="nearest"){let n=Math.floor(4*t+.5),s=[];for(let a=-n;a<=n;a++)s.push(Math.exp(-.5*a*a/(t*t)));let r=s.reduce((a,o)=>a+o,0);return i.map((a,o)=>{let l=0;for(let c=-n;c<=n;c++)l+=s[c+n]*i[Zp(o+c,i.length,e)];return l/r})}function Zp(i,t,e){if(e==="nearest")return Math.min(Math.max(i,0),t-1);let n=2*t,s=(i%n+n)%n;return s<t?s:n-1-s}function Jp(i,t,e){let n=Math.floor(t/2);return i.map((s,r)=>{let a=i[r];for(let o=-n;o<=t-1-n;o++)a=e(a,i[Zp(r+o,i.length,"reflect")]);return a})}var yu=(i,t)=>Jp(i,t,Math.max),Kp=(i,t)=>Jp(i,t,Math.min),Wn=i=>i.map((t,e)=>e===0?i[1]-i[0]:e===i.length-1?i[e]-i[e-1]:(i[e+1]-i[e-1])/2);function Rn(i,t){let e=[...i].sort((a,o)=>a-o),n=(e.length-1)*t/100,s=Math.floor(n),r=e[Math.min(s+1,e.length-1)];return e[s]+(n-s)*(r-e[s])}function Yo(i,t,e){if(i<=t[0])return e[0];if(i>=t[t.length-1])return e[e.length-1];let n=0,s=t.length-1;for(;s-n>1;){let r=n+s>>1;t[r]<=i?n=r:s=r}return e[n]+(e[s]-e[n])*(i-t[n])/(t[s]-t[n])}var xu=(i,t,e)=>Array.from({length:e},(n,s)=>e===1?i:i+(t-i)*s/(e-1));function Gt(i){let t=Math.floor(i);return i-t!==.5?Math.round(i):t%2===0?t:t+1}var _y=3,yy=.15;function jo(i){let e=.92*(Is+["spine1","spine2","spine3","neck","head"].reduce((n,s)=>n+_e.offsets[Ae[s]][1],0));for(let n=Math.max(0,i.frames-_y);n<i.frames;n++){let{positions:s}=En(i,n);if(!(s[Ae.head][1]>e)||["l_wrist","r_wrist"].some(r=>s[Ae[r]][1]-s[0][1]>=yy))return!1}return!0}function va(i,t){let e=Math.max(Math.floor(Math.min(t,i.length)/2)*2+1,1),n=e>>1,s=i.length-1;return i.map((r,a)=>{let o=0;for(let l=-n;l<=n;l++)o+=i[Math.min(Math.max(a+l,0),s)];return o/e})}function Mi(i,t,e){let n=0,s=i[0]<=t;for(let r of i)s&&r>t?(n++,s=!1):r<e&&(s=!0);return n}var Zo=(i,t)=>i.map(e=>e[t]),vu=(i,t)=>{let e=[0,1,2].map(n=>va(Zo(i,n),t));return i.map((n,s)=>[e[0][s],e[1][s],e[2][s]])},Un=(i,t)=>i.map((e,n)=>[e[0]-t[n][0],e[1]-t[n][1],e[2]-t[n][2]]),xa=i=>i.map(t=>Math.hypot(...t)),Ls=i=>i.reduce((t,e)=>t+e,0),xy=i=>[Math.min(...i),Math.max(...i)];function Qo(i){let{fps:t,frames:e}=i,n=Array.from({length:e},(f,d)=>En(i,d)),s=va(Array.from(ur(i)),Gt(.5*t)),r={},a=f=>r[f]??=vu(n.map(({positions:d})=>d[Ae[f]]),Gt(.1*t)),o=f=>Un(a(f),a("pelvis")).map(([d,p,_],m)=>{let[g,x]=[Math.sin(s[m]),Math.cos(s[m])];return[d*x-_*g,p,d*g+_*x]}),l=n.map(({world:f})=>[f[Ae.spine3][1],f[Ae.spine3][4],f[Ae.spine3][7]]),c={fps:t,frames:e,heading:s,joint:a,seen:o,up:l,path:vu(a("pelvis"),Gt(.3*t))},h=Wn(Zo(c.path,0)),u=Wn(Zo(c.path,2));return c.ground=h.map((f,d)=>Math.hypot(f,u[d])*t),{seconds:e/t,...vy(i),...My(c),...wy(c),...Ey(c),...Ay(c),...Ty(c)}}function vy(i){let t=i.quaternions,e=88,n=0,s=0;for(let r=e;r<t.length;r+=4){let a=r-e,o=Math.abs(t[r]*t[a]+t[r+1]*t[a+1]+t[r+2]*t[a+2]+t[r+3]*t[a+3]);n+=Math.acos(Math.min(o,1))}for(let r=0;r<i.frames;r++){let[a,o,l,c]=t.subarray(r*e,r*e+4),h=i.root[r*3+1];(1-2*(o*o+c*c))/Math.max(a*a+o*o+l*l+c*c,1e-9)>.3&&h>.2&&h<2&&s++}return{angularSpeed:2*n/(t.length/4-22)*i.fps,upright:s/i.frames}}function My({fps:i,heading:t,path:e,seen:n}){let s=[],r=[],a=[];for(let m=0;m+1<e.length;m++){let[g,x]=[e[m+1][0]-e[m][0],e[m+1][2]-e[m][2]],[w,M]=[Math.sin(t[m]),Math.cos(t[m])];s.push(g*w+x*M),r.push(g*M-x*w),a.push(Math.hypot(g,x))}let o=a.map(m=>m*i>.12),l=m=>m.filter((g,x)=>o[x]),c=Math.max(l(a).length/i,.5),h=[0,1,2].map(m=>e[e.length-1][m]-e[0][m]),[u,f]=[Math.sin(t[0]),Math.cos(t[0])],d=[Ls(r),Ls(s)],p=Math.max(Math.hypot(...d),1e-6),_=Un(n("l_ankle"),n("r_ankle")).map(m=>(m[0]*d[0]+m[2]*d[1])/p);return{forward:d[1],lateral:d[0],forwardNet:h[0]*u+h[2]*f,lateralNet:h[0]*f-h[2]*u,forwardSpeed:Ls(l(s))/c,lateralSpeed:Ls(l(r))/c,cruise:o.some(Boolean)?Rn(l(a),70)*i:0,stride:(Rn(_,97)-Rn(_,3))/2,yaw:t[t.length-1]-t[0]}}var im=()=>Math.abs(_e.offsets[Ae.l_elbow][0])+Math.abs(_e.offsets[Ae.l_wrist][0]);function wy({fps:i,joint:t,seen:e}){let n={handPeak:[],handTravel:[],handSwings:[]};for(let s of"lr"){let r=Un(t(`${s}_wrist`),t(`${s}_shoulder`)).map(o=>o[1]/im()),a=Un(e(`${s}_wrist`),e("spine3"));n.handPeak.push(Rn(r,95)),n.handTravel.push(Ls(xa(Un(a.slice(1),a.slice(0,-1))))),n.handSwings.push(by(a.filter((o,l)=>r[l]>-.1)))}return n}function by(i){if(i.length<4)return 0;let t=Un(i,vu(i,31)),e=[0,1,2].map(r=>Ls(Zo(t,r))/t.length),n=[0,1,2].map(r=>[0,1,2].map(a=>Ls(t.map(o=>(o[r]-e[r])*(o[a]-e[a]))))),s=Sy(n).slice(0,2).map(r=>{let a=t.map(o=>o[0]*r[0]+o[1]*r[1]+o[2]*r[2]);return Mi(a,.03,-.03)+Mi(a.map(o=>-o),.03,-.03)});return Math.max(...s)}function Sy(i){let t=i.map(n=>[...n]),e=[[1,0,0],[0,1,0],[0,0,1]];for(let n=0;n<30;n++)for(let[s,r]of[[0,1],[0,2],[1,2]]){if(Math.abs(t[s][r])<1e-300)continue;let a=(t[r][r]-t[s][s])/(2*t[s][r]),o=Math.sign(a||1)/(Math.abs(a)+Math.hypot(a,1)),l=1/Math.hypot(o,1),c=o*l;for(let h of[t,e])for(let u of h)[u[s],u[r]]=[l*u[s]-c*u[r],c*u[s]+l*u[r]];for(let h=0;h<3;h++)[t[s][h],t[r][h]]=[l*t[s][h]-c*t[r][h],c*t[s][h]+l*t[r][h]]}return[0,1,2].sort((n,s)=>t[s][s]-t[n][n]).map(n=>e.map(s=>s[n]))}function Ey({fps:i,heading:t,joint:e,seen:n,up:s,ground:r}){let a=[];for(let M of"lr"){let E=Un(e(`${M}_wrist`),e(`${M}_shoulder`)),T=xa(E),y=T.map(D=>D/im()),A=Un(n(`${M}_wrist`),n(`${M}_shoulder`)),F=va(Wn(y).map(D=>+(D*i>1.5)),Gt(.4*i)),N=y.map((D,B)=>Math.abs(E[B][0]*s[B][0]+E[B][1]*s[B][1]+E[B][2]*s[B][2])<.6*T[B]&&A[B][2]>.25&&F[B]>.05?D:Math.min(D,.7));a.push(Mi(N,.85,.72))}let o=xa(Un(e("l_wrist"),e("r_wrist"))),[l,c]=[n("l_wrist"),n("r_wrist")],h=o.map((M,E)=>(l[E][2]+c[E][2])/2>.12&&(l[E][1]+c[E][1])/2>.05?-M:-1),u=e("pelvis"),f=s.map((M,E)=>{let T=M[0]*Math.sin(t[E])+M[2]*Math.cos(t[E]),y=Math.asin(Math.min(Math.max(T,-1),1))*180/Math.PI;return u[E][1]>.83*Is&&r[E]<.5?y:Math.min(y,25)}),d=Math.max(Gt(i/3),1),p=Math.floor(d/2),_=va(o.map(M=>+(M<.3)),d),m=l.map((M,E)=>M.map((T,y)=>(T+c[E][y])/2)),g=xa(Un(m.slice(d),m.slice(0,-d))).map((M,E)=>_[E+p]>.99?M:0),x=va(f,5),w=s.map(()=>!1);for(let M of[e("l_wrist"),e("r_wrist")]){let E=xa(Un(M,e("head"))),T=Un(M,e("spine3"));s.forEach((y,A)=>{w[A]||=E[A]<.45&&y.reduce((F,N,D)=>F+N*T[A][D],0)>0})}return{punches:a,claps:Mi(h,-.17,-.24),slashes:Mi(g,.4,.2),bows:Mi(x,35,18),calls:Mi(x.map((M,E)=>w[E]?M:0),40,18)}}function Ay({joint:i,seen:t}){let e=Un(i("l_ankle"),i("r_ankle")).map(s=>s[1]);return{kicks:[["l",e],["r",e.map(s=>-s)]].map(([s,r])=>{let a=t(`${s}_ankle`);return Mi(r.map((o,l)=>a[l][2]>.3?o:Math.min(o,.2)),.33,.25)})}}function Ty({fps:i,joint:t,seen:e,ground:n}){let s=t("pelvis").map(u=>u[1]),r=t("l_foot").map((u,f)=>Math.min(u[1],t("r_foot")[f][1])),a=Rn(r,10),o=r.map(u=>u-a),l=Un(e("l_ankle"),e("r_ankle")),c=o.map((u,f)=>s[f]>Is+.03&&Math.hypot(l[f][1],l[f][2])<.3&&n[f]<2.6?u:0),h=o.map((u,f)=>u<.06?Is-s[f]:0);return{squats:Mi(h,.27,.12),jumps:Mi(c,.05,.02),pelvisLow:xy(s)[0]/Is,flight:o.filter(u=>u>.03).length/i}}var Jo=.7,sm=.06,Ry=i=>i.upright>.9&&i.angularSpeed>.02&&i.angularSpeed<6,rm=(i,t,e)=>t>.3&&e>.17&&i.stride>sm,Cy=i=>rm(i,i.forward,i.forwardSpeed)&&Math.abs(i.lateral)<.6*i.forward,jp=(i,t)=>rm(i,t*i.lateral,t*i.lateralSpeed/.7)&&t*i.lateral>.25*Math.abs(i.forward),Ko=(i,t)=>i.handPeak[t]>-.2&&i.handTravel[t]>.15,Qp=(i,t)=>Ko(i,t)&&i.handPeak[t]-i.handPeak[1-t]>.35,Py=i=>{let t=i.handPeak[1]>i.handPeak[0]?1:0;return Ko(i,t)&&i.handSwings[t]>=4},Iy=i=>Cy(i)&&(i.cruise>2||i.flight>.05*i.seconds&&i.cruise>1.3),Mu=(i,t)=>Math.hypot(i.forwardNet,i.lateralNet)>t*i.seconds,am=(i,t)=>Math.abs(i.forwardNet)<t&&Math.abs(i.lateralNet)<t,Ly=i=>i.cruise<2&&i.flight<.05*i.seconds&&(Mu(i,.25)||Math.abs(i.yaw)>Jo&&i.cruise>.5)&&i.stride>sm&&i.pelvisLow>.82,Ny=i=>(jp(i,1)||jp(i,-1))&&Math.abs(i.lateralNet)>Math.abs(i.forwardNet),Dy=i=>Math.abs(i.yaw)>Jo&&am(i,.6)&&Math.max(...i.handPeak)<-.3,Oy=i=>Math.abs(i.forward)<.4&&Math.abs(i.lateral)<.4&&Math.max(...i.handPeak)<-.3&&Math.abs(i.yaw)<.5&&i.angularSpeed<1&&i.pelvisLow>.9&&i.stride<.1&&i.bows===0,tm=i=>Ko(i,0)||Ko(i,1),om=i=>Object.fromEntries(Object.entries(i).map(([t,e])=>[t,n=>Ry(n)&&e(n)])),lm=om({walk:Ly,run:Iy,wave:Py,"side-step":Ny,turn:Dy,stand:Oy,"crouch-walk":i=>i.pelvisLow<.85&&Mu(i,.2),spin:i=>Math.abs(i.yaw)>4.7&&am(i,.8),kick:i=>Math.max(...i.kicks)>=1,punch:i=>Math.max(...i.punches)>=1&&!Mu(i,.25),slash:i=>i.slashes>=1,call:i=>i.calls>=1,raise:tm,bye:tm,squat:i=>i.squats>=1,jump:i=>i.jumps>=1,clap:i=>i.claps>=1,bow:i=>i.bows>=1}),em=om({"turn-left":i=>i.yaw>Jo,"turn-right":i=>-i.yaw>Jo,"left-hand":i=>Qp(i,0),"right-hand":i=>Qp(i,1),"kick-left":i=>i.kicks[0]>i.kicks[1],"kick-right":i=>i.kicks[1]>i.kicks[0],"punch-left":i=>i.punches[0]>i.punches[1],"punch-right":i=>i.punches[1]>i.punches[0]});function cm(i,t,e){let n=i==="spin"?`turn-${t}`:`${i}-${t}`;return em[n]??(e?em[`${t}-hand`]??null:null)}var nm=([i,t],e)=>e==="left"?i:e==="right"?t:i+t,tl={bow:i=>i.bows,clap:i=>i.claps,jump:i=>i.jumps,squat:i=>i.squats,kick:(i,t)=>nm(i.kicks,t),punch:(i,t)=>nm(i.punches,t)},hm=(i,t,e)=>tl[i]?.(t,e)??null;var Uy=.5,um=.12,Fy=.4,By=.01,ky=.08,zy=.5,Gy=-3,Vy=2,Hy=.2,Wy=2/30,Xy=3/30,$y=8/30,qy=12/30,Yy=9/30,Zy=8/30,Jy=.1,Ky=.1,Ma=.01,jy=.05,Qy=.005,bu=.22,tx=2.5,ex=[0,.5,1],el=.9,nx=150;function fm(i,t,e,n,s){let r=ix(i,s,n),a=i.map((u,f)=>u.map((d,p)=>Ee(d,r[f][p]))),o=sx(a,t,e,n),l=rx(t,n),c=o.map(u=>u.map((f,d)=>f&&l[d])),h=o.map(u=>u.map((f,d)=>f&&!l[d]));return ox(a,t,h,n,s).forEach((u,f)=>{let d=px(a[f],u,s[f],c[f],n);r[f]=r[f].map((p,_)=>Ee(p,d[_]));for(let p of u)c[f].fill(!0,p.start,p.stop)}),{shifts:r,planted:c}}function ix(i,t,e){let n=i[0].length,s=Array.from({length:n},(r,a)=>Math.min(i[0][a][1],i[1][a][1])-Qn);return s=Kp(s,2*Gt(Fy*e)+1),s=s.map(r=>Math.sign(r)*Math.max(Math.abs(r)-By,0)),s=s.map(r=>r*jn(2-Math.abs(r)/um,0,1)),t.map(r=>{let a=yu(r.map(Number),2*Gt(.2*e)+1);return Tn(s.map((l,c)=>l*(1-a[c])),.1*e).map((l,c)=>[0,r[c]?0:-l,0])})}function sx(i,t,e,n){let s=i.map(c=>c.map(h=>h[1]-Qn)),r=s.map((c,h)=>c.map((u,f)=>e[h][f]>Uy&&u<um));if(i[0].length<2)return r;let a=s.map(c=>Wn(c).map(h=>Math.abs(h)*n)),o=Tn(t[0].map((c,h)=>(c[1]+t[1][h][1])/2),.05*n),l=Wn(Wn(o)).map(c=>c*n*n<Gy);return r.map((c,h)=>c.map((u,f)=>{if(u)return!0;let d=s[0][f]<=s[1][f]?0:1,p=s[h][f]<ky&&a[h][f]<zy&&!l[f];return!r[0][f]&&!r[1][f]&&p&&d===h}))}function rx(i,t){if(i[0].length<2)return i[0].map(()=>!1);let e=[0,2].map(n=>Wn(i[0].map((s,r)=>(s[n]+i[1][r][n])/2)));return Tn(e[0].map((n,s)=>Math.hypot(n,e[1][s])*t),Hy*t).map(n=>n>=Vy)}function ax(i,t){let e=[];for(let n=0,s=-1;n<=i.length;n++)if(i[n]&&s<0&&(s=n),!i[n]&&s>=0){let r=e[e.length-1];r&&s-r[1]<=t?r[1]=n:e.push([s,n]),s=-1}return e}function ox(i,t,e,n,s){let r=e[0].map((o,l)=>(e[0][l]||e[1][l])&&!s[0][l]&&!s[1][l]),a=new Su(i,t,r,n,s);for(let[o,l,c]of lx(i,e,n,s))a.stand(o,l,c);return a.stepOn(i[0].length,null),a.found}var Su=class{constructor(t,e,n,s,r){Object.assign(this,{balls:t,hips:e,free:n,fps:s,kept:r,found:[[],[]],until:0,last:0}),this.shortest=Math.min(Gt(Xy*s),t[0].length),this.swing=Gt($y*s),this.sooner=Gt(qy*s)}stand(t,e,n){this.stepOn(t,n),this.gap(t)&&t-this.until<=this.sooner&&(t=Math.max(this.ready(n),Math.min(t,this.until))),this.plant(t,e,n)}stepOn(t,e){for(;this.gap(t)&&(t-this.until>this.sooner||e===null||e===this.last);){let n=this.until,s=1-this.last;if(this.plant(this.ready(s),s===e?t-this.swing:t,s),this.until===n)break}}gap(t){return this.until<t&&this.free.slice(this.until,t).every(Boolean)}ready(t){let e=this.found[t];return Math.max(this.until,e.length?e[e.length-1].stop+this.swing:0)}plant(t,e,n){let s=this.balls[n],r=this.hips[n],a=[];for(let h=t;h<e;h++)this.kept[n][h]&&a.push(h-t);let o,l,c;if(a.length)o=Eu(s[t+(a[0]===0?a[a.length-1]:a[0])]),[l,c]=dx(o,r,t,e);else{if(e-t<this.shortest)return;[o,l,c]=fx(s,r,t,e,this.shortest)}a.length||(l=this.landing(o,l,n)),c-l>=this.shortest&&(this.found[n].push({start:l,stop:c,point:o}),c>this.until&&(this.until=c,this.last=n))}landing(t,e,n){let s=this.found[n].at(-1);if(!s)return e;let r=Math.hypot(...t.map((c,h)=>c-s.point[h])),a=Math.ceil(Math.sqrt(6*r/nx)*this.fps),o=Math.min(e-a,s.stop);return o===s.stop?e:this.kept[n].slice(Math.max(o,0),s.stop).some(Boolean)||o-s.start<this.shortest?s.stop+a:(s.stop=o,e)}};function lx(i,t,e,n){let s=[];for(let r of[0,1])for(let[a,o]of cx(t[r],i[r],e)){let c=n[r].slice(a,o).some(Boolean)?[[a,o]]:hx(i[r].slice(a,o),a,e,.5*r);for(let[h,u]of c)s.push([h,u,r])}return s.sort((r,a)=>r[0]-a[0]||r[1]-a[1]||r[2]-a[2])}function cx(i,t,e){let n=[];for(let[s,r]of ax(i,0)){let a=n[n.length-1];(a?Math.hypot(t[s][0]-t[a[1]-1][0],t[s][2]-t[a[1]-1][2]):1/0)<=bu&&s-a[1]<=Gt(Wy*e)?a[1]=r:n.push([s,r])}return n}function hx(i,t,e,n){let s=[[t,t+i.length]],r=i.map(w=>w[0]),a=i.map(w=>w[2]),o=w=>w.reduce((M,E)=>M+E,0)/w.length,[l,c]=[o(r),o(a)];if(Math.max(...r.map((w,M)=>Math.hypot(w-l,a[M]-c)))<=bu)return s;let[h,u]=[Tn(r,.1*e),Tn(a,.1*e)],f=[0];for(let w=1;w<h.length;w++)f.push(f[w-1]+Math.hypot(h[w]-h[w-1],u[w]-u[w-1]));let d=Gt(Zy*e),p=f[f.length-1],_=Math.min(Math.ceil(p/(2*bu)),Math.floor(i.length/(2*d)));if(_<2)return s;let m=Math.floor(d/2),g=[-m];for(let w=1;w<=_;w++){let M=(w-n)/_;M<1-1e-9&&g.push(ux(f,M*p))}g.push(i.length+m);let x=[];for(let w=1;w<g.length;w++){let[M,E]=[g[w-1]+m,g[w]-m];E>M&&x.push([t+Math.max(M,0),t+Math.min(E,i.length)])}return x}function ux(i,t){let e=i.findIndex(n=>n>=t);return e<0?i.length:e}var Eu=i=>[i[0],Qn,i[2]];function Au(i,t,e){let n=[0,0,0];for(let s=t;s<e;s++)n=Ee(n,i[s]);return Le(n,1/(e-t))}function fx(i,t,e,n,s){for(let r=e;r<=n-s;r++)for(let a=n;a>=r+s;a--){let o=Au(i,r,a),l=Au(t,r,a);for(let c of ex){let h=Eu(Ee(Le(o,1-c),Le(l,c))),u=0;for(let f=r;f<a;f++)u=Math.max(u,jt(Pe(t[f],h)));if(u<=el)return[h,r,a]}}return[Eu(i[e]),e,e]}function dx(i,t,e,n){let s=t.slice(e,n).map(l=>jt(Pe(l,i))),r=s.indexOf(Math.min(...s));if(s[r]>el)return[e,e];let a=r,o=r+1;for(;a>0&&s[a-1]<=el;)a--;for(;o<s.length&&s[o]<=el;)o++;return[e+a,e+o]}function px(i,t,e,n,s){let r=i.length,a=i.map(()=>[0,0,0]),o=[...e],l=new Array(r).fill(0);for(let h of t){let u=i.slice(h.start,h.stop),f=e.slice(h.start,h.stop).some(Boolean)?null:mx(u,s);u.forEach((d,p)=>{let _=Pe(h.point,d);f&&(_[0]+=f[p][0],_[2]+=f[p][2]),_[1]=jn(d[1],Qn,Qn+Qy)-d[1],a[h.start+p]=_,o[h.start+p]=!0})}e.forEach((h,u)=>{h&&(a[u]=[0,0,0])});for(let h=1;h<t.length;h++){let[u,f]=[t[h-1],t[h]];if(n.slice(u.stop,f.start).some(Boolean))continue;let d=f.start-u.stop,p=Math.min(Jy,Ky*jt(Pe(f.point,u.point)));for(let _=0;_<d;_++)l[u.stop+_]=p*Math.sin(Math.PI*(_+1)/(d+1))**2}a=gx(a,o,Gt(Yy*s),s);for(let h=0;h<r;h++){if(o[h]||l[h]===0)continue;let u=l[h]-(i[h][1]+a[h][1]-Qn),f=jn((u+Ma)/(2*Ma),0,1)**2*Ma;a[h][1]+=(u<Ma?f:u)*Math.min(l[h]/Ma,1)}return _x(i.map((h,u)=>h[1]+a[u][1]),o,s).forEach((h,u)=>{a[u][1]+=h}),a}function mx(i,t){let e=Au(i,0,i.length),n=i.map(r=>[r[0]-e[0],0,r[2]-e[2]]),s=0;for(let r=1;r<n.length;r++)s+=jt(Pe(n[r],n[r-1]));return s=s*t/Math.max(i.length-1,1),n.map(r=>Le(r,Math.min(1,jy/Math.max(s,1e-9))))}function gx(i,t,e,n){let s=i.map(c=>[...c]),r=tx/n,a=s.length,o=[0,0,0],l=(c,h)=>{let u=c>=0&&c<a?s[c]:o,f=o;return Math.min(c,h)>=0&&Math.max(c,h)<a&&t[h]&&(f=Le(Pe(s[c],s[h]),c-h)),[u,f.map(d=>jn(d,-r,r))]};for(let c=0;c<a;c++){if(t[c])continue;let h=c;for(;h<a&&!t[h];)h++;let[u,f]=l(c-1,c-2),[d,p]=l(h,h+1),_=h-c+1;if(c>0&&h<a&&_<=2*e){let m=wu(u,d,f,p,_);for(let g=c;g<h;g++)s[g]=m[g-c+1]}else{let m=wu(u,o,f,o,e),g=wu(o,d,o,p,e);for(let x=c,w=1;x<h;x++,w++)c>0&&(s[x]=Ee(s[x],m[Math.min(w,e)])),h<a&&(s[x]=Ee(s[x],g[Math.max(w-_+e,0)]))}c=h}return s}function wu(i,t,e,n,s){return Array.from({length:s+1},(r,a)=>{let o=a/s,l=o*o,c=l*o;return[0,1,2].map(h=>(2*c-3*l+1)*i[h]+(c-2*l+o)*s*e[h]+(3*l-2*c)*t[h]+(c-l)*s*n[h])})}function _x(i,t,e){let n=i.map((r,a)=>t[a]?0:Math.max(Qn-r,0));if(!n.some(Boolean))return n;let s=2*Gt(.1*e)+1;return Tn(yu(n,s),s/6).map((r,a)=>t[a]?0:r)}var yx=1e-4,xx=1.5/30,vx=.5/30,Mx=10,wx=.995,bx=.97,Sx=.8,dm=.02,Ex=.1;function mm(i){let t=i.length/At;return hi.map(([e,n,s])=>Array.from({length:t},(r,a)=>[e,n,s].some(o=>{for(let l=0;l<6;l++)if(i[a*At+o*6+l])return!0;return!1})))}var Ax=i=>[0,1].map(()=>new Array(i).fill(!1));function il(i,t=null){let e=i.frames,n=Array.from({length:e},(u,f)=>En(i,f)),s=ma.map(({ball:u})=>n.map(({positions:f})=>f[u])),r=hi.map(([u])=>n.map(({positions:f})=>f[u])),a=[0,1].map(u=>Array.from({length:e},(f,d)=>i.contacts[d*2+u])),{shifts:o,planted:l}=fm(s,r,a,i.fps,t??Ax(e)),c=i.quaternions.slice(),h=new Float32Array(e*2);for(let u of[0,1])for(let f=0;f<e;f++)if(h[f*2+u]=t?.[u][f]?a[u][f]:Number(l[u][f]),!(jt(o[u][f])<=yx))for(let[d,p]of Tx(u,n[f],o[u][f])){let _=(f*$t+d)*4,m=0;for(let g=0;g<4;g++)m+=p[g]*i.quaternions[_+g];c.set(m<0?p.map(g=>-g):p,_)}return{...i,quaternions:c,contacts:h}}function Tx(i,{positions:t,world:e},n){let[s,r,a,o]=hi[i],l=Ee(t[o],n),c=Pe(t[a],t[o]),h=Math.max(jt(Pe(t[a],t[s])),bx*pa),u=Cx(t[s],l,c,h),[f,d]=Tu(t[s],e[s],e[r],_e.offsets[r],_e.offsets[a],Ee(l,Ye(u,c))),p=[e[_e.parents[s]],f,d,be(u,e[a]),e[o]];return[s,r,a,o].map((_,m)=>[_,gn(be(ci(p[m]),p[m+1]))])}function gm(i,t=null){return pm(il(pm(il(i,t),xx,t),t),vx,t)}function pm(i,t,e){let n=i.quaternions.slice(),s=$t*4;return hi.forEach((r,a)=>{for(let o of r){let l=new Float64Array(i.frames*4);for(let h=0;h<i.frames;h++)l.set(i.quaternions.subarray(h*s+o*4,h*s+o*4+4),h*4);Dn(l,4);let c=[0,1,2,3].map(h=>Tn(Array.from({length:i.frames},(u,f)=>l[f*4+h]),t*i.fps));for(let h=0;h<i.frames;h++){if(e?.[a][h])continue;let u=Math.hypot(...c.map(f=>f[h]));n.set(c.map(f=>f[h]/u),h*s+o*4)}}}),{...i,quaternions:n}}function _m(i,t,e){let n=t.quaternions.slice();return hi.forEach((s,r)=>{let a=Rx(e[r]);for(let o=0;o<t.frames;o++){let l=Math.min(a[o]/Mx,1),c=l*l*(3-2*l);for(let h of s){let u=(o*$t+h)*4;n.set(Ni(Array.from(i.quaternions.subarray(u,u+4)),Array.from(t.quaternions.subarray(u,u+4)),c),u)}}}),{...t,quaternions:Dn(n,$t*4)}}function Rx(i){let t=i.map(e=>e?0:1/0);for(let e=1;e<t.length;e++)t[e]=Math.min(t[e],t[e-1]+1);for(let e=t.length-2;e>=0;e--)t[e]=Math.min(t[e],t[e+1]+1);return t}function Cx(i,t,e,n){let s=Pe(i,t),r=jt(e),a=jt(s),o=(r*r+a*a-n*n)/(2*r*a),l=Li(e,s),c=Math.atan2(jt(l),li(e,s));return da(Ge(l),jn(c-Math.acos(jn(o,-1,1)),0,Sx))}function Tu(i,t,e,n,s,r,a=[-1,0,0]){let o=jt(n),l=jt(s),c=jt(Ee(Ye(t,n),Ye(e,s))),h=Math.max(c,wx*(o+l)),u=1.05*Math.abs(o-l)+.05,f=jt(Pe(r,i)),d=Math.max(Math.min(f,h),Math.min(c,u));for(let p=0;p<2;p++){let _=Ye(t,n),m=Ee(_,Ye(e,s)),g=Px(m,_,Ye(t,a)),x=jt(m),w=nl(o,d,l)-nl(o,x,l),M=nl(o,l,d)-nl(o,l,x);t=be(da(g,w),t),e=be(da(g,w+M),e);let E=Yp(Ee(Ye(t,n),Ye(e,s)),Pe(r,i));t=be(E,t),e=be(E,e)}return[t,e]}var nl=(i,t,e)=>Math.acos(jn((i*i+t*t-e*e)/(2*i*t),-1,1));function Px(i,t,e){let n=Li(i,t),s=jt(n)/Math.max(jt(i)*jt(t),1e-9),r=jn((s-dm)/(Ex-dm),0,1),a=Ge(i);return e=Pe(e,Le(a,li(e,a))),Ge(Ee(Le(Ge(n),r),Le(Ge(e),1-r)))}function Ix(i,t){if(t.length===1)return i;let e=ge(i),n=t.length>>1,s=i.slice();for(let r=0;r<e;r++)for(let a=0;a<ae+cr;a++){let o=0;for(let l=-n;l<=n;l++)o+=t[l+n]*i[Math.min(Math.max(r+l,0),e-1)*At+a];s[r*At+a]=o}return s}var ym=(i,t,e)=>e.map((n,s)=>i[s]?t[s]:n);function Lx(i){let t=ge(i),e=i.slice(),n=new Float64Array(t),s=[];for(let r=0;r<t;r++)s.push(Cs(i,r*At)),n[r]=Xo(s[r]);Ps(n);for(let r=0;r<t;r++)ua(be(fa(-n[r]),s[r]),e,r*At);return e}function Nx(i,t,e){if(t===null)return i;let n=$t*4,s=t/e,r=i.slice();for(let a=n;a<r.length;a+=4){let o=Array.from(r.subarray(a-n,a-n+4)),l=Wo(ha(du(o),Array.from(i.subarray(a,a+4)))),c=Math.hypot(...l);c>s&&r.set(ha(o,lr(l.map(h=>h*s/c))),a)}return Dn(r,n)}function Ns(i,t,{known:e=null,text:n="",place:s=hr,carried:r=!1}={}){let a=Ix(i,t.smoothing);e&&(a=ym(e,i,Lx(ym(e,i,a))));let o=ts(a,s,n);if(o={...o,quaternions:Nx(o.quaternions,t.maxVelocity,St)},!t.footLock)return o;let l=r?gm:il,c=e&&mm(e);return!c||!c.some(h=>h.some(Boolean))?l(o):_m(o,l(o,c),c)}var Dx=.5,Ox={collar:[0,0,0],shoulder:[0,0,-1.37],elbow:[0,-.38,0],wrist:[0,0,0]};function Ru(i,t=null,e=!1){let n=i.frames-1,s=[[[0,1]],[[n,-1]]].slice(0,e?1:2),r=t?.map(l=>[[l-1,-1],[l,1]])??s,a=Math.round(Dx*i.fps);if(i.frames<4*a)return i;let o=i.quaternions.slice();for(let l of r){let c=l.map(([h])=>En(i,h).positions);for(let[h,u]of[["l",1],["r",-1]])if(!c.every(f=>f[Ae[`${h}_wrist`]][1]<f[0][1]))for(let[f,d]of l)for(let[p,_]of Object.entries(Ox)){let m=lr([_[0],_[1]*u,_[2]*u]);for(let g=0;g<a;g++){let x=1-g/a,w=x**3*(10-15*x+6*x*x),M=((f+d*g)*$t+Ae[`${h}_${p}`])*4;o.set(Ni(Array.from(o.subarray(M,M+4)),m,w),M)}}}return{...i,quaternions:Dn(o,$t*4)}}var Ux=.09,Fx=.35,xm=.15;function sl(i,t=0,e=i.frames){let n=Array.from({length:e-t},(o,l)=>En(i,t+l)),s=n.map(({positions:o})=>Pe(o[ga[1].at(-1)],o[ga[0].at(-1)])),r=Bx(s.map(jt)),a=i.quaternions.slice();if(!r.some(Boolean))return i;for(let[o,{positions:l,world:c}]of n.entries())if(r[o])for(let[h,[u,f,d,p]]of ga.entries()){let _=Ee(l[p],Le(Ge(s[o]),(h?-1:1)*r[o]/2)),[m,g]=Tu(l[f],c[f],c[d],_e.offsets[d],_e.offsets[p],_,[0,h?-1:1,0]),x=[c[u],m,g,c[p]];for(let[w,M]of[f,d,p].entries())a.set(gn(be(ci(x[w]),x[w+1])),((t+o)*$t+M)*4)}return{...i,quaternions:Dn(a,$t*4)}}function Bx(i){let t=[],e=i.map(()=>0),n=0,s=0,r=!1;for(let[l,c]of i.entries())c<i[n]&&(n=l),c>i[s]&&(s=l),r&&c-i[n]>=xm?(i[n]<Fx&&t.push(n),[r,s]=[!1,l]):!r&&i[s]-c>=xm&&([r,n]=[!0,l]);let a=[0,...t,i.length-1],o=a.slice(1).map((l,c)=>{let h=a[c];for(let u=h+1;u<=l;u++)i[u]>i[h]&&(h=u);return h});for(let[l,c]of t.entries())for(let h of[o[l],o[l+1]])for(let u=Math.min(c,h);u<=Math.max(c,h);u++){let f=(i[h]-i[u])/(i[h]-i[c]);e[u]=Math.min(Math.max(f,0),1)*Math.max(i[c]-Ux,0)}return e}var kx=10;function Cu(i,t,e=kx){let n=ge(i),s=Float64Array.from(i),r=ae+cr;for(let a of[!1,!0]){let o=c=>(a?n-1-c:c)*At,l=(c,h)=>t[o(c)+h];for(let c=1;c<n;c++){let h=new Uint32Array(r),u=new Float64Array(r);for(let d=0;d<r;d++){if(!l(c-1,d)||l(c,d))continue;let p=g=>o(g)+d,_=[],m=1;for(;c+m<n&&!l(c+m,d);)m++;m>1&&_.push(s[p(c+1)]-s[p(c)]),c>1&&_.push(l(c-2,d)?s[p(c-1)]-s[p(c-2)]:_[0]??0),u[d]=s[p(c-1)]+(_.length?_.reduce((g,x)=>g+x,0)/_.length:0),h[d]=m}let f=(d,p)=>{let _=c+d===n?e:Math.min(e,Math.max(1,d>>1));for(let m=0;m<Math.min(d,_);m++)p(o(c+m),1-(m/_)**3*(m/_*(6*m/_-15)+10))};for(let d=0;d<r;d+=6){let p=h.subarray(d,d+6);if(d<ae&&p[0]&&p.every(_=>_===p[0])){let _=be(Cs(u,d),ci(Cs(s,o(c)+d))),m=Wo(gn(_));f(p[0],(g,x)=>ua(be(je(lr(Le(m,x))),Cs(s,g+d)),s,g+d))}else for(let[_,m]of p.entries()){if(!m)continue;let g=u[d+_]-s[o(c)+d+_];f(m,(x,w)=>{s[x+d+_]+=g*w})}}}}return Float32Array.from(s)}var vm=0xffffffffn;function Mm(i,t){let[e,n,s,r]=[i>>>16,i&65535,t>>>16,t&65535],a=e*r+(n*r>>>16),o=n*s+(a&65535);return e*s+Math.floor(a/65536)+Math.floor(o/65536)>>>0}function wm(i,t,e,n,s,r,a){for(let o=0;o<10;o++){let[l,c]=[Mm(3528531795,i),Mm(3449720151,e)],[h,u]=[Math.imul(3528531795,i)>>>0,Math.imul(3449720151,e)>>>0];[i,t,e,n]=[(c^t^s)>>>0,u,(l^n^r)>>>0,h],s=s+2654435769>>>0,r=r+3144134277>>>0}a[0]=i,a[1]=t,a[2]=e,a[3]=n}var bm=i=>[Number(BigInt(i)&vm),Number(BigInt(i)>>32n&vm)];function Pu(i,t){if(t===0)return BigInt(i);let e=[];return wm(t,0,0,4294967295,...bm(i),e),BigInt(e[0])+(BigInt(e[1]>>>1)<<32n)}function Sm(i,t,e){let n=new Float32Array(e),s=zx(new TextEncoder().encode(t)),r=[0,0,0,0],[a,o]=bm(i);for(let l=0;l<e;l+=4){wm(l>>>2,0,s,0,a,o,r);for(let c of[0,2]){let h=Math.sqrt(-2*Math.log((r[c]+.5)/4294967296)),u=2*Math.PI*(r[c+1]+.5)/4294967296;n[l+c]=h*Math.cos(u),n[l+c+1]=h*Math.sin(u)}}return n}function zx(i){let t=-1;for(let e of i){t^=e;for(let n=0;n<8;n++)t=t>>>1^3988292384&-(t&1)}return~t>>>0}var rl=150,Ds=30,Gx=48,Lu=8,Iu=10,Vx=.05,Hx=30,ti=i=>({values:new Float32Array(i*At),known:new Uint8Array(i*At),shown:new Uint8Array(i*At).fill(1)}),Nu=(i,t,e)=>({values:He(i.values,t,e),known:He(i.known,t,e),shown:He(i.shown,t,e)});function Wx(i,t){let e=t-ge(i.values);if(e<=0)return i;let n=ti(e);return{values:On([i.values,n.values]),known:On([i.known,n.known],Uint8Array),shown:On([i.shown,n.shown],Uint8Array)}}function Xx(i,t,e,n){let s=1+Math.max(0,Math.ceil((i+t-e)/(e-n))),r=i+t+(s-1)*n,a=o=>Math.floor(r*o/s);return Array.from({length:s},(o,l)=>a(l+1)-a(l)-(l?n:t))}function $x(i){let t=ge(i);if(t<Iu)return!1;let e=ts(He(i,t-Iu,t));if(!jo(e))return!1;let n=Array.from({length:Iu},(s,r)=>En(e,r).positions);return["pelvis","l_ankle","r_ankle"].every(s=>[0,1,2].every(r=>{let a=n.map(o=>o[Ae[s]][r]);return Math.max(...a)-Math.min(...a)<Vx}))}function qx(i,t,e){let n=On([new Uint8Array(i.length).fill(1),e.slice(0,t.length)],Uint8Array),s=ge(i);return He(Cu(On([i,t]),n,Hx),s,s+ge(t))}var Du=i=>Array.from({length:Lu},(t,e)=>Pu(i,e));async function wi(i,t,e,n={}){let{constraint:s=null,window:r=rl,overlap:a=Ds,guidance:o,told:l}=n,c=new Float32Array,h=0,u=0,f=null,d=[];for(let p of t){let _=new Float32Array,m=[],g=p.afresh&&p.text!==f&&$x(c)?new Float32Array:c;f=p.text;for(let x of Xx(p.frames,ge(g),Math.min(r,p.window??r),a)){let w=ge(g),M=h-w,E=s?Nu(s,M,h+x):ti(w+x);E.values.set(g),E.known.fill(1,0,g.length),E.shown.fill(1,0,g.length);let T=Wx(E,Gx),y=w>0||s,A=null,F=1/0,N=null;for(let B of[...m,...Du(Pu(e,u))]){let Z=await i.sample(p.text,ge(T.values),B,y?T:null,o),P=He(Cu(He(Z,0,w+x),E.known),w,w+x);!w&&c.length&&(P=qx(c,P,E.known));let $=p.miss?p.miss(On([_,P])):0;if($<F&&(F=$,A=P,N=B),F<=0)break}let D=On([c,A]);g=c=He(D,Math.max(0,ge(D)-a),ge(D)),_=On([_,A]),m=p.window?[N]:[],h+=x,u++,d.push(A),l?.(h)}}return On(d)}var Em="a person moves",Yx=20,Ou=i=>new Set(i.flatMap(t=>_a[t]??(t in Ae?[t]:[])));function Uu(i,t,e,n){let s=new Uint8Array(i.length).fill(1),r=new Uint8Array(i.length).fill(n===null?1:0),a=new Set([..._a["left-leg"],..._a["right-leg"]]);for(let o=t;o<e;o++){let l=o*At;if(n===null){s.fill(0,l,l+At);continue}for(let c of n)s.fill(0,l+Ae[c]*6,l+Ae[c]*6+6);[...n].some(c=>a.has(c))&&s.fill(0,l+ae+cr,l+At)}return{values:i,known:s,shown:r}}function Am(i,t,e,n){let s=n!==null||e>=i.frames;return{constraint:Uu(_u(i),t,e,n),place:fr(i,0),rejoin:s?null:{stop:e,place:fr(i,e)}}}function Tm(i,t,e,n,s=!1){let r=ti(n),a=(o,l,c)=>{r.values.set(He(_u(o),l,l+e),c*At),r.known.fill(1,c*At,(c+e)*At)};return i&&a(i,0,0),t&&a(t,t.frames-e,n-e),{constraint:r,place:i?fr(i,0):hr,rejoin:t&&s?{stop:n-e,place:fr(t,t.frames-e)}:null}}var Zx=.95,Jx=.08,Kx=4;function Rm(i,t){let e=ts(i),n=ur(e),s=Array.from({length:e.frames},(f,d)=>{let{positions:p}=En(e,d),[_,m]=[Math.sin(n[d]),Math.cos(n[d])],[g,,x]=p[0];return p.map(([w,M,E])=>[(w-g)*m-(E-x)*_,M,(w-g)*_+(E-x)*m])}),r=(f,d)=>f.map((p,_)=>Math.hypot(...p.map((m,g)=>m-d[_][g]))),a=s.map(f=>r(f,s[0]).reduce((d,p)=>d+p,0)/$t),o=a.findIndex(f=>f>=Zx*Math.max(...a)),l=s.slice(o).findIndex(f=>Math.max(...r(f,s[o]))>Jx),c=(l<0?s.length-o:l)-1,h=Math.PI/Math.max(c,Gt(Kx/2*St)),u=ti(t);for(let f=0;f<t;f++){let d=f<o?f:Gt(o+c*(1-Math.cos(h*(f-o)))/2);u.values.set(He(i,Math.min(d,s.length-1),Math.min(d,s.length-1)+1),f*At);for(let p of[_n,An,Ve])u.values[f*At+ae+p]=0}return u.known.fill(1,o*At),u}async function Cm(i,t,e,n,s){let r=await al(i,t,e.constraint,n,s);if(!e.rejoin)return{features:r,known:e.constraint.known};let a=Qx(r,e);return{features:await al(i,t,a,n,s),known:a.known}}async function al(i,t,e,n,s={}){let r=ge(e.values),a=[];for(let d=0;d<r;d++)He(e.known,d,d+1).includes(0)&&a.push(d);if(!a.length)return e.values;let o=Math.max(0,a[0]-Ds),l=Math.min(r,a[a.length-1]+1+Ds),{miss:c,...h}=s,u=await wi(i,[{text:t,frames:l-o,miss:c}],n,{...h,constraint:Nu(e,o,l)}),f=On([He(e.values,0,o),u,He(e.values,l,r)]);return e.shown&&!e.shown.includes(1)&&jx(f,e,a[0],a.at(-1)+1),f}function jx(i,{values:t,known:e},n,s){let r=Math.min(Yx,Math.floor((s-n)/3)),a=o=>(o/(r+1))**2*(3-2*o/(r+1));for(let o=n;o<s;o++){let l=1;n>0&&o-n<r&&(l=a(o-n+1)),s<ge(i)&&s-o<=r&&(l=a(s-o));for(let c=o*At;l<1&&c<o*At+ae;c++)e[c]||(i[c]=i[c]*l+t[c]*(1-l))}}function Qx(i,{constraint:t,place:e,rejoin:{stop:n,place:s}}){let r=0;for(;t.known[r*At+ae+_n];)r++;let a=Float64Array.from(He(i,0,n+1)),o=Array.from({length:n+1},(m,g)=>{let x=g<r?0:(g-r)/(n-r);return x**3*(x*(6*x-15)+10)}),l=qo(a,e).heading,c=s.heading-l[n]+Math.PI,h=2*Math.PI,u=(c%h+h)%h-Math.PI;for(let m=0;m<n;m++)a[m*At+ae+Ve]+=u*(o[m+1]-o[m])*St;let f=qo(a,e),d=[s.x-f.path[n*3],s.z-f.path[n*3+2]],p=t.values.slice(),_=t.known.slice();for(let m=r;m<n;m++){let g=[0,2].map((E,T)=>(f.path[(m+1)*3+E]-f.path[m*3+E]+(o[m+1]-o[m])*d[T])*St),[x,,w]=pu([g[0],0,g[1]],-f.heading[m]),M=m*At+ae;p[M+_n]=w,p[M+An]=x,p[M+Ve]=a[M+Ve],_[M+_n]=_[M+An]=_[M+Ve]=1}return{...t,values:p,known:_}}var Pm=.01,Im=.12,Nm=1.2,Dm=.25,wa=4,tv=2,ev=1.5,nv=2.5,iv=4,sv=.1,Lm=.4,Om=2,rv=3e3,av=.12,ov=.25,lv=.4,ba=i=>i.slice(1).map((t,e)=>[t[0]-i[e][0],t[1]-i[e][1]]),dr=i=>ba(i).reduce((t,e)=>t+Math.hypot(...e),0);function Fu(i,{speed:t=Nm,seconds:e=null,facing:n=0}){if(dr(i)>rv)throw Um(dr(i)/wa);let s=cv(i),r=hv(s,Math.min(Math.max(t,Dm),wa)),a=t>Om?0:e===null?Lm:Math.min(Lm,e/8),o=Math.trunc(a*St);e!==null&&(r=uv(s,r,e-2*o/St));let l=r[r.length-1],c=l*St,h=xu(0,l,Math.max(2,(e===null&&c<St?Math.ceil(c):Gt(c))+1));h=[...new Array(o).fill(h[0]),...h,...new Array(o).fill(l)];let[u,f]=[s.map(p=>p[0]),s.map(p=>p[1])],d=h.map(p=>[Yo(p,r,u),Yo(p,r,f)]);return{points:d,headings:dv(fv(d).map(p=>p+n))}}function cv(i){let t=dr(i),e=[0];for(let h of ba(i))e.push(e[e.length-1]+Math.hypot(...h));let n=e.map(h=>h/t),s=n.map((h,u)=>u===0||h>n[u-1]),r=n.filter((h,u)=>s[u]),a=i.filter((h,u)=>s[u]),o=xu(0,1,Math.max(3,Math.ceil(t/Pm)+1)),l=Math.min(Math.ceil(4*Im/Pm),o.length-1),c=[0,1].map(h=>{let u=o.map(p=>Yo(p,r,a.map(_=>_[h]))),f=u.length-1,d=[];for(let p=l;p>0;p--)d.push(2*u[0]-u[p]);for(let p of u)d.push(p);for(let p=1;p<=l;p++)d.push(2*u[f]-u[f-p]);return Tn(d,Im*f/t,"reflect").slice(l,l+u.length)});return o.map((h,u)=>[c[0][u],c[1][u]])}function hv(i,t){let e=ba(i),n=e.map(h=>Math.max(Math.hypot(...h),1e-9)),s=Ps(e.map(([h,u])=>Math.atan2(h,u))),r=n.length>1?Wn(s).map((h,u)=>Math.abs(h)/n[u]):[0];r=Tn(r,5);let a=r.map(h=>Math.min(Math.max(Math.min(Math.sqrt(tv/Math.max(h,1e-6)),nv/Math.max(h,1e-6)),Math.min(Dm,t)),t)),o=a.length-1;if(t<=Om)for(let h of[0,o])a[h]=Math.min(a[h],sv);let l=(h,u)=>{a[h]=Math.min(a[h],Math.sqrt(a[u]**2+2*ev*n[h]))};for(let h=1;h<=o;h++)l(h,h-1);for(let h=o-1;h>=0;h--)l(h,h+1);let c=[0];return n.forEach((h,u)=>c.push(c[u]+h/a[u])),c}function uv(i,t,e){let n=t.map(r=>r*e/t[t.length-1]),s=ba(i).reduce((r,a,o)=>Math.max(r,Math.hypot(...a)/(n[o+1]-n[o])),0);if(!(e>0)||s>wa)throw Um(Math.max(e,0)*s/wa||dr(i)/wa);return n}var Um=i=>new Error(`The path is too long for its time: give it ${i.toFixed(1)} seconds or more, or draw a shorter one.`);function fv(i){let t=ba(i),e=t.map(r=>Math.hypot(...r)*St>.05);e.some(Boolean)||e.fill(!0);let n=e.indexOf(!0),s=t.map((r,a)=>(e[a]&&(n=Math.max(n,a)),Math.atan2(...t[n])));return Ps(s),[...s,s[s.length-1]]}function dv(i){let t=av*St,e=Tn(i,t),n=()=>Math.max(...e.slice(1).map((s,r)=>Math.abs(s-e[r])))*St;for(;n()>iv&&t<i.length;)t*=1.25,e=Tn(i,t);return e}function Bu(i){let t=Array.from({length:ge(i)},(r,a)=>i[a*At+ae+Ve]),e=Tn(t,lv*St),n=t.map((r,a)=>r-e[a]),s=n.reduce((r,a)=>r+a,0)/n.length;return n.map(r=>r-s)}function ku({points:i,headings:t},e){let[n,s]=[Wn(i.map(u=>u[0])),Wn(i.map(u=>u[1]))],r=n.map((u,f)=>Math.hypot(u,s[f])),a=Math.max(...r,1e-9),o=i.length-1,l=0,c=e.map((u,f)=>(l+=u*r[f]/a)/St),h=u=>c[0]+(c[o]-c[0])*u/o;return{points:i,headings:t.map((u,f)=>u+c[f]-h(f))}}function zu({points:i,headings:t}){let e=ti(i.length);return i.forEach((n,s)=>{let r=Math.min(s,i.length-2),[a,o]=[(i[r+1][0]-i[r][0])*St,(i[r+1][1]-i[r][1])*St],[l,c]=[Math.sin(t[s]),Math.cos(t[s])],h=s*At+ae;e.values[h+_n]=a*l+o*c,e.values[h+An]=a*c-o*l,e.values[h+Ve]=(t[r+1]-t[r])*St,e.known[h+_n]=e.known[h+An]=e.known[h+Ve]=1}),e}async function pr(i,t,e,n={}){let s=await wi(i,[{text:t,frames:90}],e,n),r=[],a=[0,0],o=ge(s),l=Array.from({length:o-30},(f,d)=>s[(d+30)*At+ae+ya]),c=Rn(l,50),h=0;for(let f=0;f<o;f++){let d=[s[f*At+ae+_n],s[f*At+ae+An]];r.push(Math.hypot(...d)),d.forEach((p,_)=>{a[_]+=p/o}),h+=s[f*At+ae+Ve]/o}if(Math.hypot(...a)<ov)return{speed:Nm,facing:0,turning:h,height:c};let u=-Gt(Math.atan2(a[1],a[0])/(Math.PI/2))*(Math.PI/2);return{speed:Rn(r,75),facing:u,turning:h,height:c}}var Xu=" 	,;.!?:()/+&|。、，！？：；（）「」…—–·-";var es="stands still",Gu="sits",pv="squats down";var Wu=/\u23f8(?:([\d.]+)\u23f8)?/u;var Wm={action:"stand",certainty:3,arms:!1},Sa={ups:[Wm,es],bends:[{action:"turn",certainty:3,arms:!1},"turns left"],posed:[{action:"raise",certainty:3,arms:!0},"raises both arms"]},Ea=["walk","run","crouch-walk"],mr=["sit","kneel","meditate"],Fm=["raise","bow","squat"],mv=[["after_seconds",1],["later_seconds",1],["after_minutes",60],["later_minutes",60]],ei=0,ol=-14,Vu=-2,gv=8,ui=({action:i,certainty:t})=>t>ei?i:null,Hu=i=>i.replace(new RegExp(Wu.source,"gu"),""),_v=/[\u3040-\u30ff\u3400-\u9fff]/u,Bm=/(?<![^\s,;:.])(?:(?:step|schritt|paso|étape|etape|take|toma|prise)\s*)?(\p{Nd}\p{Nd}?)\s*[.):](?!\p{Nd})\s*/giu,km=/\s+|(?<=[\u3040-\u30ff\u3400-\u9fff]{2})(?=[\u3040-\u30ff\u3400-\u9fff]{2})/gu,gr=i=>({text:i,count:1,degrees:null,metres:null,seconds:null,steps:null,meanwhile:"",side:"both",held:!1,unheard:""}),cl=i=>i.count===1&&i.degrees===null&&i.metres===null&&i.seconds===null&&i.steps===null&&!i.meanwhile&&i.side==="both"&&!i.held;function Xn(i,t=Xu){let e=0,n=i.length;for(;e<n&&t.includes(i[e]);)e++;for(;n>e&&t.includes(i[n-1]);)n--;return i.slice(e,n)}var Oi=i=>i.trim().split(/\s+/u).join(" ").normalize("NFKC"),yv=i=>i.slice(0,[...i].findLastIndex(t=>!Xu.includes(t))+1),zm=i=>[...i].slice([...i].findIndex(t=>!Xu.includes(t))).join(""),ns=i=>i.toLowerCase().replaceAll("ß","ss").replaceAll("’","'").replaceAll("ı","i").normalize("NFD").replace(/\p{M}/gu,""),$u=/[\p{L}\p{N}_]+/gu;function qu(i,t){let e=t?ns:n=>n.toLowerCase().replaceAll("ß","ss");return` ${(Oi(i).match($u)??[]).map(e).join(" ")} `}var Di=(i,t)=>[...i.matchAll(t)].map(e=>[e.index,e.index+e[0].length]),ll=(i,t,e=ei)=>Math.min(i.certainty,t.certainty)>e&&i.action!==t.action,Gm=({metres:i,steps:t,degrees:e})=>i!==null||t!==null||e!==null,Vm=(i,t)=>i!==t&&i!=="both"&&t!=="both";function Xm(i,t){let[e,n]=[i,t].map(({parts:r,passed:a,certainty:o})=>[r.length,-a.length,o]),s=e.findIndex((r,a)=>r!==n[a]);return s<0||e[s]>n[s]}var Hm=i=>i.reduce((t,e)=>Xm(t,e)?t:e),_r=class{constructor({patterns:t,...e},n,s=()=>!1){let r=o=>n(Sa[o][1]).action===Sa[o][0].action;Object.assign(this,e,{learned:r,plainRead:n,read:o=>{let l=Object.keys(Sa).find(c=>this.entire[c].test(o)&&r(c));return l?Sa[l][0]:n(this.bared(o))},strange:s}),this.first={},this.each={},this.head={},this.entire={},this.there={};for(let[o,l]of Object.entries(t))this.first[o]=new RegExp(l,"iu"),this.each[o]=new RegExp(l,"giu"),this.head[o]=new RegExp(`^(?:${l})`,"iu"),o in Sa&&(this.entire[o]=new RegExp(`^(?:${l})$`,"iu"))}clauses(t){let e=this.staying(Oi(this.tidied(t))),n=[];for(let o of this.ordered(e)){let l=n.at(-1),{parts:c,unheard:h}=this.joined(o),u=(o.match(/[てで]、/gu)??[]).length>1;for(;c.length;){let[f,...d]=c,p=d.length?this.atOnce(f,d[0],u):null,_=p??this.parted(f)??this.measured(f);n.push(l?this.asBefore(l,_):_),l=null,c=p?d.slice(1):d}n.push({...n.pop(),unheard:h})}let s=n.filter(o=>o.text);s.length||(s=[gr(t)]);let{text:r}=s[0],a=this.learned("ups");return this.first.downs.test(r)&&mr.includes(this.read(r).action)?s.unshift({...gr(es),seconds:.8}):a&&mr.includes(this.read(Gu).action)&&(this.first.ups.test(r)?s.unshift({...gr(Gu),seconds:.8}):r===es&&s.length===2&&this.first.ups.test(s[1].text)&&(s[0]={...s[0],text:Gu})),s.map(o=>this.inPlainWords(o,s.length===1))}inPlainWords(t,e){let{text:n,meanwhile:s}=t;(s||!e)&&(n=this.bared(n)),this.learned("ups")&&(n=n.replace(this.first.ups,es)),!e&&this.first.bends.test(n)&&this.learned("bends")&&ui(this.plainRead(n))!=="turn"&&(n=n.replace(this.first.bends,`turns ${this.sideOf(n)}`)),this.entire.posed.test(s)&&this.learned("posed")&&ui(this.plainRead(s))!=="raise"&&(s=`raises ${t.side} arm${t.side==="both"?"s":""}`);let r=t.metres===null&&t.degrees===null?this.placeKept(n):null;if(r){let a=this.without(n,r);if(Ea.includes(ui(this.plainRead(a))))return{...t,text:a,meanwhile:s,metres:0}}return{...t,text:n,meanwhile:s}}bared(t){let e=t.replace(this.first.subject,"");return e!==t&&!ui(this.plainRead(t))&&ui(this.plainRead(e))?e:t}whole(t,e){let n=this.tidied(t),[{text:s}]=e;return e.length===1&&cl(e[0])&&s!==this.trimmed(Oi(n))?s:n}staying(t){for(let e=0;;){let n=["held","halts"].map(m=>this.match(m,t,e)).filter(Boolean);if(!n.length)return t;let s=n.reduce((m,g)=>g.index<m.index?g:m),r=s.index+s[0].length,a=this.lasting(t,r),o=a?a[0]:r,l=t.slice(0,s.index),c="",h=l.slice(l.lastIndexOf(" → ".trim())+1),u=Di(h,this.each.joint).at(-1),f=[u?h.slice(u[1]):h,h].map(m=>ui(this.reading(this.trimmed(m)))).find(Boolean)??null;/[不没别勿]/u.test(l.slice(-4))&&(f=null);let[d,p]=["held","halts"].map(m=>this.match(m,t,s.index,!0));if(d&&f==="crouch-walk"&&(ui(this.reading(this.trimmed(h+s[0])))==="squat"||this.first.crouches.test(h))&&([l,f]=[l.slice(0,l.length-h.length)+pv,"squat"]),d&&Fm.includes(f)?c=a?`⏸${a[1]}⏸`:"⏸":d&&mr.includes(f)?c=a?` for ${1.5+a[1]} seconds`:" ":p&&f&&![...Fm,...mr].includes(f)&&(c=` → ${es} for ${a?a[1]:2.5} seconds`),e=r,!c)continue;let _=Xn(t.slice(o));t=`${l}${c}${_?" → ":""}${_}`,e=l.length+c.length}}match(t,e,n,s=!1){let r=s?this.there[t]??=new RegExp(this.each[t].source,"iuy"):this.each[t];r.lastIndex=n;let a=r.exec(e);return r.lastIndex=0,a}lasting(t,e){e+=t.length-e-t.slice(e).trimStart().length;for(let n of["seconds","minutes"]){let s=this.match(n,t,e,!0);if(s)return[e+s[0].length,this.measured(s[0]).seconds??0]}return null}asBefore(t,e){if(e.degrees!==null||!this.first.sideways.test(e.text))return e;let[n,s]=[e,t].map(({text:a})=>this.first.left.exec(a)??this.first.right.exec(a));if(!n||!s||this.first.no_side.test(t.text))return e;let{text:r}=t;return{...e,text:r.slice(0,s.index)+n[0]+r.slice(s.index+s[0].length)}}tidied(t){let e=this.withoutManners(t);return e===Oi(t)?t:e}withoutManners(t){let e=Oi(t.replace(/([\u2460-\u2468])/gu," $1) "));e=e.replace(this.first.greeting,""),e=(e.replace(this.first.closing,"")||e).replace(this.each.short,o=>o.slice(0,-1)),e=e.replace(this.first.halt_alone,es),e=e.replace(this.each.idiom,o=>this.plainly[ns(o)]),e=e.replace(this.each.goal,(...o)=>{let l=Oi(o.at(-1).way).toLowerCase();return this.plainly[l]??this.plainly[ns(l)]}),e=zm(e.replace(this.each.instead,(o,...l)=>l.find(Number.isInteger)&&/[,;，、]$/u.test(o.trimEnd())?", ":""))||e;let n=e;e=e.replace(this.each.undone,(o,...l)=>{let c=l.find(Number.isInteger),h=n.slice(0,c),u=Xn(n.slice(c+o.length));return this.first.arms.test(h)?this.first.held.test(`${h},`)?` → ${es} for ${1.5} seconds${u?" → ":""}`:"":o}),e=e.replace(this.each.late,"$<pause> $<verb> $<rest>");for(let[o,l]of mv)e=e.replace(this.each[o],(...c)=>{let{number:h,half:u}=c.at(-1),f=(this.value(h)+(u?.5:0))*l;return f?` → ${es} for ${f} seconds → `:c[0]});if(e.startsWith(" → ".trimStart())&&(e=e.slice(" → ".trimStart().length)),e.endsWith(" → ")){let o=e.slice(0,-3).split(" → "),l=o.pop();e=[...o.slice(0,-1),l,...o.slice(-1)].join(" → ")}let s=[...e.matchAll(Bm)],[r]=s;if(s.length<2||!s.every((o,l)=>Number(o[1])===l+1))return e;let a=e.slice(0,r.index).trim();return(/[:：]$/u.test(a)||a.split(/\s+/u).filter(Boolean).length<3)&&(e=e.slice(r.index+r[0].length)),e.replace(Bm," → ")}ordered(t){let e=this.head.after.exec(t),n=e?null:this.head.before.exec(t),s=e??n,r=s&&this.subordinate(t.slice(s[0].length));r&&!this.isTime(t,0,r[0])&&(r=null),n&&r?.reverse();for(let[a,o]of[["beforehand",!0],["then",!1],["earlier",!1],["later",!0],["before",!1],["after",!0]])for(let[l,c]of r?[]:Di(t,this.each[a])){let h=t.slice(0,l),u=t.slice(c);if(a==="then"&&this.beginsAfter(t,l,c))continue;let f=a==="before"||a==="after",d=f&&this.first.ended.exec(h);if(d&&(this.first.comma.test(u.trimStart().slice(1))||!d.groups.stop&&this.subordinate(u))){r=[h,t.slice(l)];break}if(f&&!this.isTime(t,l,u,!0))continue;let _=f&&t.slice(l,c).trimStart()[0]===","&&this.first.named.test(h.trim())&&this.first.comma.test(u)&&this.subordinate(u);if(_){let m=`${h} ${_[1].trimStart()}`;r=o?[_[0],m]:[m,_[0]];break}if(a==="then"&&/^\s*\p{L}/u.test(t.slice(l,c))&&([h,u]=this.around(h,u,t.slice(l,c))),!(!Xn(h)||!Xn(u))){r=o?[u,h]:[h,u];break}}return r?r.flatMap(a=>this.ordered(a)):[this.trimmed(this.head.then.test(t)?t.replace(this.each.then," "):t)]}beginsAfter(t,e,n){let s=t.slice(e,n),r=zm(s),a=this.head.after.exec(t.slice(n-r.length)),o=a===null?"":t.slice(n-r.length+a[0].length);return a===null||this.head.seconds.test(o)||this.head.minutes.test(o)?!1:a[0].trimEnd().length>yv(r).length}isTime(t,e,n,s=!1){if(!this.head.noun.test(t.slice(e)))return!0;let{action:r,certainty:a,known:o=!0}=this.reading(this.trimmed(n.split(this.first.stop)[0]));return r===null||a>ei&&(o||!s)}subordinate(t){let e=Di(t,this.each.comma);if(!e.length){let s=["then","joint"].map(o=>this.first[o].exec(t)?.index).filter(o=>o!==void 0),r=Di(t,km),a=Math.min(...s);return s.length&&this.best(t,r.filter(([,o])=>o<a))||this.best(t,r)}let n=this.best(t,e)??[t.slice(0,e[0][0]),t.slice(e[0][1])];return n.every(s=>Xn(s))?n:null}around(t,e,n){let s=Di(t,this.each.joint).at(-1),r=s?t.slice(s[1]):"";return Xn(r)?Xn(e)&&!this.head.verb_then.test(n)&&(ll(this.read(this.trimmed(r)),this.read(this.trimmed(e)))||r.trim().split(/\s+/u).length>3||_v.test(r))?[t,e]:[t.slice(0,s[0]),`${r.trimEnd()} ${e.trimStart()}`]:[t,e]}joined(t){let e=this.head.denial.exec(t)??this.first.refusal.exec(t),n=e&&this.trimmed(t.slice(0,e.index));if(e&&!(n&&this.read(n).certainty>ei)){let p=this.trimmed(t.slice(e.index+e[0].length)),_=this.reading(p),m=ui(this.read(this.trimmed(e[0])));(_.certainty>ei||p&&m&&m!==_.action)&&(t=p)}let s=[[0,0],...Di(t,this.each.joint),[t.length,t.length]],r=s.slice(1).map(([p],_)=>[s[_][1],p]).filter(([p,_])=>Xn(t.slice(p,_))),a=r.map(p=>this.trimmed(t.slice(...p))),o=r.map((p,_)=>this.isAside(t.slice(...p),!_)),l=p=>this.first.meanwhile.test(p)||Wu.test(p),c=a.map((p,_)=>r.length>1&&!o[_]&&!l(p)&&!ui(this.reading(p))&&this.strange(p)),h=[new Map([["",{parts:[],passed:[],certainty:0,action:null,side:"both",far:!1}]])];for(let p=1;p<=r.length;p++){let _=new Map([...h[p-1]].map(([m,g])=>[m,{...g,passed:[...g.passed,p-1]}]));for(let m=Math.max(0,p-gv);m<p;m++){if(o[m]&&(m||o.slice(0,p).every(Boolean))||c.slice(m,p).some(Boolean))continue;let g=this.trimmed(t.slice(r[m][0],r[p-1][1])),x=this.measured(g),w=Gm(x),{action:M,certainty:E}=this.reading(g),T=this.sideOf(g),y=w&&Ea.includes(M)||x.seconds!==null&&M==="stand",A=`${M} ${T} ${w}`,F=[...h[m].values()].filter(P=>P.action!==M||E>ei&&(Vm(P.side,T)||w&&P.far));if(!F.length||E<=(y?ol:ei))continue;let{parts:N,passed:D,certainty:B}=Hm(F),Z={parts:[...N,g],passed:D,certainty:B+E,action:M,side:T,far:w};(!_.has(A)||Xm(Z,_.get(A)))&&_.set(A,Z)}h.push(_)}let{parts:u,passed:f}=Hm([...h.at(-1).values()]),d=c.some(Boolean)&&u.some(p=>this.reading(p).known??!0);return u.length>1||d?{parts:u,unheard:Hu(f.map(p=>a[p]).join(", "))}:{parts:[t],unheard:""}}isAside(t,e){let n=Xn(t.replace(this.each.aside," "));return!n||!e&&this.head.lacking.test(n)}best(t,e){let n=null,s=ei;for(let[r,a]of e){let o=[t.slice(0,r),t.slice(a)].map(h=>this.trimmed(h)),[l,c]=o.map(h=>this.reading(h));if(c===Wm&&ll(l,c))return o;ll(l,c,s)&&([n,s]=[o,Math.min(l.certainty,c.certainty)])}return n}atOnce(t,e,n){let s=[t,e].some(l=>this.first.meanwhile.test(l)||this.first.throughout.test(l)),r=this.pair(t,e,s?Vu:ei);if(!r)return null;let a=this.head.sign.test(e),o=this.first.manner.test(t)&&r.clause.meanwhile===t&&!n;return s||r.oneArmEach||!r.armsAlone&&(a||o)?r.clause:null}parted(t){let[e,n,s]=["meanwhile","joint","sign"].map(c=>Di(t,this.each[c])),r=e.length>0||this.first.throughout.test(t),a=this.namesBoth(t),o=s.map(([c])=>[c,c]),l=[...o,...r||a?Di(t,km):[]];for(let[c,h,u]of[[e,ol,ol],[n,a?ol:Vu,Vu],[l,ei,ei]]){let f=null;for(let[d,p]of c){let _=this.pair(t.slice(0,d),t.slice(p),h),m=d===p&&o.some(([g])=>g===d);!_||!(_.oneArmEach||r&&_.certainty>u||m&&!_.armsAlone)||(!f||_.certainty>f.certainty)&&(f=_)}if(f)return f.clause}for(let[c,h]of Di(t,this.each.posed)){let u=this.pair(`${t.slice(0,c).trimEnd()} ${t.slice(h).trimStart()}`,t.slice(c,h),ei);if(u&&(u.oneArmEach||!u.armsAlone))return u.clause}return null}namesBoth(t){let e=t.replace(this.each.no_side," ");return[this.first.left,this.first.right,this.first.other].filter(n=>n.test(e)).length>1}sides(t){let e=t.map(n=>this.sideOf(n));return t.forEach((n,s)=>{e[s]==="both"&&e[1-s]!=="both"&&this.first.other.test(n)&&(e[s]=e[1-s]==="right"?"left":"right")}),e}naming(t,e){return e==="both"||this.sideOf(t)===e?t:t.replace(this.each.other,n=>this.others[ns(n)][+(e==="right")])}pair(t,e,n){let s=[t,e].map(f=>this.trimmed(f.replace(this.each.throughout," ").replace(this.each.meanwhile," ")));if(s.some(f=>this.first.limb.test(f)))return null;let[r,a]=s.map(f=>this.reading(f));if(!(r.arms||a.arms)||!ll(r,a,n))return null;let[o,l]=r.arms&&!a.arms?[1,0]:[0,1],c=this.sides(s),h=r.arms&&a.arms,u=s.map((f,d)=>this.naming(f,c[d]));return{clause:{...this.measured(u[o]),meanwhile:Hu(u[l]),side:c[l]},certainty:Math.min(r.certainty,a.certainty),armsAlone:h,oneArmEach:h&&Vm(...c)}}reading(t){return this.read(this.measured(t).text)}sideOf(t){let e=t.replace(this.each.no_side," "),[n,s]=[this.first.left.test(e),this.first.right.test(e)];return n===s?"both":n?"left":"right"}goesRound(t){return this.first.round.test(t)&&!this.first.corner.test(t)}placeKept(t){let e=this.first.in_place.exec(t);if(!e||this.first.off.test(t))return null;let n=Xn(t.slice(0,e.index)),s=Xn(t.slice(e.index+e[0].length));if(/^[\u3040-\u30ff\u3400-\u9fff]/u.test(e[0]))return s?e:null;let r=!n&&s.split(/\s+/u).length<=2,a=!s||this.head.sign.test(s),o=this.first.sign.test(n)||this.first.joint.test(n);return r||a&&!o?e:null}saysOften(t){return this.first.many.test(t)}saysNumber(t){return this.first.often.test(t)||this.first.times.test(t)}turnsHead(t){return this.first.head_turns.test(t)}measured(t){let e=Wu.exec(t);if(!e)return this.withMeasures(t);let n=this.withMeasures(Hu(t));if(Gm(n)||n.count>1)return n;let s=e[1]===void 0?n.seconds:(n.seconds??1.5)+Number(e[1]);return{...n,seconds:s,held:!0}}withMeasures(t){let e=gr(t),n=this.sideOf(t.replace(this.each.angle," "));for(let[o,[l,c,h]]of Object.entries(this.units)){let u=[...e.text.matchAll(this.each[o])].find(({groups:w})=>this.value(w.number)>=h);if(!u)continue;let{half:f,manner:d,noun:p}=u.groups;if(o==="steps"&&this.first.uncounted.test(d??""))continue;let _=(this.value(u.groups.number)+(f?.5:0))*c+(e[l]??0);if(!(_>0&&_<=this.most[l]))continue;let m=e.text.slice(0,u.index);if(this.first.larger.test(m))return e;let g=o==="steps"&&(!m.trim()||this.first.takes.test(m))?this.stepping(d??"",this.steps[ns(p)]):"",x=this.without(e.text,u,g);(x||o!=="steps")&&(e={...e,text:x,[l]:_})}let s=e.degrees===null&&n!=="both"&&this.first.angle.exec(e.text);s&&(e={...e,degrees:this.angles[ns(s[0])]});let r=this.first.corner.test(t)||this.first.round.test(t),a=this.first.about.test(e.text)&&!r&&this.counted(e).count===1;return e.degrees===null&&a&&(e={...e,degrees:180}),e.degrees!==null?{...e,degrees:(n==="right"?-1:1)*e.degrees}:e.metres===null&&e.seconds===null&&e.steps===null?this.counted(e):e}stepping(t,e){let n=e.lastIndexOf(" ");return`${e.slice(0,Math.max(n,0))} ${t}${e.slice(n+1)}`.trim()}counted(t){let e=this.first.often.exec(t.text),n;if(e)n=this.adverbs[ns(e[0])];else{if(e=this.first.times.exec(t.text)??this.first.bare.exec(t.text),!e)return t;n=Math.trunc(this.value(e.groups.number??e.groups.after))}if(!(n>1&&n<=this.maxCount))return t;let s=this.without(t.text,e);return s?{...t,text:s,count:n}:t}value(t){let e=this.numbers[ns(t)];if(e!==void 0||!/^[一二三四五六七八九两零十百]+$/u.test(t))return e??Number(t.replace(",","."));let n=0,s=0;for(let r of t.replaceAll("零",""))"十百".includes(r)?[n,s]=[n+(s||1)*(r==="十"?10:100),0]:s=r==="两"?2:"一二三四五六七八九".indexOf(r)+1;return n+s}without(t,e,n=""){return this.trimmed([t.slice(0,e.index).trimEnd(),...n?[n]:[],t.slice(e.index+e[0].length).trimStart()].join(" "))}trimmed(t){return Xn(Xn(t).replace(this.each.loose,""))}};var hl=class{constructor(t,e){this.tokenizer=e,this.keys=t.raw("text.encoder.keys",Int32Array),this.width=t.shape("text.encoder.rows.weight")[1];let n="text.encoder.rows.weight";this.stored=t.has(`${n}.int8_scale`),this.rows=this.stored?t.raw(n,Int8Array):t.floats(n),this.scales=this.stored?t.scales(n):null,this.weight=t.floats("text.text_proj.weight"),this.bias=t.floats("text.text_proj.bias"),this.places=t.has("text.places")?t.floats("text.places"):null,this.placeKeys=t.has("text.keys")?t.floats("text.keys"):this.places,this.remembered=new Map}encode(t){return this.read(t).place}read(t){let e=this.remembered.get(t);return e||(e=this.pool(this.mean(this.tokenizer.encode(t))),this.remembered.set(t,e)),e}mean(t){let e=new Float64Array(this.width);return t.forEach((n,s)=>{let r=n<32768?n:3,a=t[s+1]<32768?t[s+1]:3;r>=3&&this.addRow(r,e),s+1<t.length&&(r>=3||a>=3)&&this.addRow((r+1)*32768+a,e)}),e.map(n=>n/t.length)}addRow(t,e){let n=0,s=this.keys.length;for(;n<s;){let a=n+s>>1;this.keys[a]<t?n=a+1:s=a}if(this.keys[n]!==t)return;let r=this.stored?this.scales[n]:1;for(let a=0;a<this.width;a++)e[a]+=this.rows[n*this.width+a]*r}pool(t){let e=ul(Array.from(this.bias,(c,h)=>{let u=c;for(let f=0;f<this.width;f++)u+=this.weight[h*this.width+f]*t[f];return u}));if(!this.places)return{place:Float32Array.from(e),closeness:null};let n=e.length,s=[];for(let c=0;c<this.places.length;c+=n){let h=0;for(let u=0;u<n;u++)h+=this.placeKeys[c+u]*e[u];s.push(30*h)}let r=Math.max(...s),a=s.map(c=>Math.exp(c-r)),o=a.reduce((c,h)=>c+h,0),l=new Array(n).fill(0);return a.forEach((c,h)=>{for(let u=0;u<n;u++)l[u]+=c/o*this.places[h*n+u]}),{place:Float32Array.from(ul(l)),closeness:r/30}}};function ul(i){let t=Math.max(Math.hypot(...i),1e-12);return i.map(e=>e/t)}var xv=.65,vv=4,Mv=.5,wv=3,bv=.5,Sv=[["bye","wave"]],Ev=/[\u3040-\u30ff\u3400-\u9fff]/u,Av=/[\u3400-\u9fff]/gu,Tv=/[\u3040-\u30ff\u3400-\u9fff]+|(?:(?![\u3040-\u30ff\u3400-\u9fff])[\p{L}\p{N}_])+/gu;function Yu(i){let t=new Set;for(let[e]of i.normalize("NFKC").toLowerCase().replaceAll("ß","ss").matchAll(Tv)){if(!Ev.test(e)){t.add(e);continue}for(let n=0;n+1<e.length;n++)t.add(e.slice(n,n+2));for(let[n]of e.matchAll(Av))t.add(n)}return t}var fl=class{constructor(t,e,n){this.meta=t,this.tower=n,this.words=new Set(t.words),this.fillers=new Set(t.fillers??t.words),this.keyWords=new Map(Object.entries(t["key-words"]));let s=e.floats("means"),r=s.length/t.actions.length;this.means=t.actions.map((a,o)=>s.subarray(o*r,(o+1)*r)),this.checkedTexts=new Map}twins(t){return Sv.find(e=>e.includes(t))??[t]}check(t){let e=this.checkedTexts.get(t);return e||(e=this.judged(t),this.checkedTexts.set(t,e)),e}judged(t){let{place:e,closeness:n}=this.tower.read(t),s=ul(Array.from(e)),r=this.means.map(m=>m.reduce((g,x,w)=>g+x*s[w],0)),{actions:a,weights:o,reliability:l={}}=this.meta,c=r.map((m,g)=>g).sort((m,g)=>r[g]-r[m]).filter(m=>a[m]),h=Yu(t),u=this.evidence(h,r,c),f=this.meta["warning-weights"],d=o?$m(u,o):this.familiar(h)?1:-1;this.meta["min-cosine"]!=null&&Math.max(...r)>=this.meta["min-cosine"]&&(d=Math.max(d,1));let p=(f&&n!=null?$m([n,...u],f):d)>0,_=c.slice(0,wv).map(m=>a[m]);return p&&_.length&&(l[_[0]]??1)<bv?{known:!1,nearest:_,unreliable:_[0],certainty:d}:{known:p,nearest:_,unreliable:null,certainty:d}}evidence(t,e,n){let{actions:s}=this.meta,[r,...a]=n,o=new Set,l=this.twins(s[r]),c=a.find(d=>!l.includes(s[d]))??r,h=0,u=!0;for(let d of t){let p=this.keyWords.get(d);if(p)p.forEach(_=>o.add(_));else for(let[_,m]of this.keyWords)qm(d,_)&&m.forEach(g=>o.add(g));this.words.has(d)&&h++,this.fillers.has(d)||(u=!1)}let f=o.size===0?0:[...o].some(d=>d===r||l.includes(s[d]))?1:-1;return[e[r],e[r]-e[c],h/Math.max(t.size,1),f,Number(u),1]}familiar(t){let e=[...t];if(e.some(r=>this.keyWords.has(r))||e.every(r=>this.words.has(r))&&!e.every(r=>this.fillers.has(r)))return!0;let n=e.filter(r=>!this.fillers.has(r)&&[...this.keyWords.keys()].some(a=>qm(r,a))),s=e.filter(r=>this.words.has(r)||n.includes(r));return n.length>0&&s.length>=Mv*e.length}warning(t){let{known:e,nearest:n,unreliable:s}=this.check(t);if(e)return null;if(s){let r=Math.round(100*this.meta.reliability[s]);return`“${t}” asks for “${s}”, which this model shows in about ${r}% of tries; look at the motion before you use it.`}return`“${t}” is far from anything this model was trained on; nearest known actions: ${n.join(", ")}.`}};function $m(i,t){return i.reduce((e,n,s)=>e+n*t[s],0)}function qm(i,t){let[e,n]=[[...i],[...t]],s=Math.max(vv,Math.ceil(xv*Math.max(e.length,n.length)));return Math.min(e.length,n.length)>=s&&e.slice(0,s).join("")===n.slice(0,s).join("")}var Ym=[...Ea,"side-step"],Rv=.0049,Zu=90,Cv=2.3,Pv=2.2,Iv=20*Math.PI/180,Zm=8,Lv=.2,Nv=75,is=.5,Jm=120,Dv=3,dl=[2.5,3],Ov=2,pl="claps three times",Uv=4,Fv=1,Bv=.15,kv=.43,zv=6,Km=1,Gv=.5,jm=10,Vv=["turn","spin"],Hv=/ (?:a|an|the|un|una|une|el|la|los|las|le|les|ein|eine|einen|den|die|das)$/u,Wv=/^[いえきぎくぐけげこしじすずせそたちってなねびべぶまみむめらりるれろん]{0,2}/u,Xv=2,$v=1.3,qv=.1,Qm=i=>i.split(/\s+/u).filter(Boolean).length,ml=class{constructor(t,e,n){Object.assign(this,{sampler:t,scope:e,settings:n,bent:new Map}),this.reader=new _r(n.measures,s=>this.reading(s),s=>this.unlearned(s))}reading(t){if(!t)return{action:null,certainty:-1/0,arms:!1};let{nearest:[e],certainty:n,known:s}=this.scope.check(t);return{action:this.scope.twins(e)[0],certainty:n,arms:this.scope.meta.arms.includes(e),known:s}}warning(t){let e=this.reader.clauses(t),n=e.flatMap(({text:l,meanwhile:c})=>[l,c]).filter(Boolean),s=null;if(n.length===1){let l=this.reader.whole(t,e),c=this.nearest(l)===this.nearest(n[0])||e[0].degrees!==null,h=this.scope.warning(l);(cl(e[0])||h===null&&c)&&(s=[h])}s??=n.map(l=>this.scope.warning(l));let r=new Set(e.filter(({degrees:l})=>l!==null).map(({text:l})=>l)),a=l=>r.has(l)&&Vv.includes(ui(this.reading(l))),o=n.map((l,c)=>this.unlearned(l)??(a(l)?null:s[c])).filter(Boolean);for(let{unheard:l}of e)l&&o.push(this.unlearned(l)??`Nothing is made of “${l}”.`);return[...new Set(o)].join(" ")||null}unlearned(t){let e=[!1,!0].map(f=>qu(t,f)),{actions:n}=this.scope.meta,s=new Set(n),r=n.map(f=>qu(f,!1)),a=f=>this.settings.ownWords&&[...Yu(f)].every(d=>this.scope.words.has(d)),o=this.settings.unlearned.filter(([f,d,p])=>e[Number(p)].includes(d)&&!f.some(_=>s.has(_))&&!r.some(_=>_.includes(d))&&!a(d)).map(([,f,d])=>({start:e[Number(d)].indexOf(f),words:f,read:e[Number(d)]})).sort((f,d)=>f.start-d.start||d.words.length-f.words.length),l=f=>`“${t}” asks ${f}, which this model has not learned.`;if(this.reader.turnsHead(t))return l("the head alone to turn");let c=[...Oi(t).matchAll($u)].map(f=>[f.index,f.index+f[0].length]),h=[],u=0;for(let{start:f,words:d,read:p}of o){if(f<u)continue;let _=d.startsWith(" ");u=f+d.length-Number(_),_?h.push(Oi(t).slice(c[Qm(p.slice(0,f))][0],c[Qm(p.slice(0,u))-1][1]).replace(Hv,"")):h.push(d+p.slice(u).match(Wv)[0])}return h.length?l(`for ${h.map(f=>`“${f}”`).join(" and ")}`):null}async make(t,e,n){let s={told:n};return t.clip?this.edited(t,e,s):t.path?this.alongPath(t,e,s):t.blocks.length===1?this.sentence(t.blocks[0].text,t.blocks[0].seconds,e,s):this.timeline(t.blocks,e,s)}async timeline(t,e,n){let s=[],r=[];for(let{text:a,frames:o}of this.passages(t)){let l=this.reader.clauses(a),c=u=>Gt(o*u/l.length),h=l.length*Lv;if(l.length>1&&o<h*St)throw new Error(`“${a}” asks for ${l.length} things in ${(o/St).toFixed(1)} seconds; give it ${h.toFixed(1)} or more.`);for(let[u,f]of l.entries())r.push(await this.stretch(f,o/St,e,c(u+1)-c(u)));s.push(...l)}return this.performed(s,r,t.map(({text:a})=>a).join(", then "),e,n)}passages(t){let e=0,n=0;return t.map(({text:s,seconds:r})=>{e+=r;let a=Gt(e*St)-n;return n+=a,{text:s,frames:a,afresh:this.beginsStanding(s)}})}beginsStanding(t){return this.scope.meta.gestures.includes(this.nearest(t))}async sentence(t,e,n,s){let r=this.reader.clauses(t),a=Gt(e*St);if(a<Zm)throw new Error(`${e} seconds are too short; ask for ${(Zm/St).toFixed(2)} or more.`);let o=this.settings.maxSeconds,l=o!==null&&a>Gt(o*St);if(r.length>1||!cl(r[0])||l||this.applauds(r[0])||await this.turns(r[0]))return this.clausesOf(t,r,e,n,s);let c=this.reader.whole(t,r),h=this.nearest(c),u=null,f=null;for(let d of Du(n)){let p=(u===null?1:Dv)*this.settings.guidance,_=await this.sampler.sample(c,a,d,null,p);mu(_,this.steady(c));let m=this.rested(Ns(_,this.settings.post,{text:t}),[c]);s.told?.(a);let g=this.does(c,m);if((u===null||g)&&(u=m),f=g||!this.scope.meta.checked.includes(h)?null:`“${t}”, read as “${h}”: none of ${Lu} samples shows that, by how joints move; try another seed or other words.`,g)break}return{...u,missed:f}}async clausesOf(t,e,n,s,r){let a=[];for(let _ of e){let m=e.length>1&&this.isSingle(_);a.push(await this.stretch(_,m?Math.min(n,dl[1]):n,s))}let{passage:o,given:l}=a.at(-1),{text:c,steps:h,seconds:u}=e.at(-1),f=this.nearest(c),d=!l&&u===null&&Ym.includes(f)?Gt(h??0)*(f==="side-step"?2:1):0;d&&(a[a.length-1]={passage:{...o,frames:o.frames+Gt($v*St+.15*o.frames)}});let p=await this.performed(e,a,t,s,r);return d?Yv(p,d,a.at(-1).passage.frames,o.frames):p}async performed(t,e,n,s,r){let a=e.map(({passage:w})=>w),o=ti(a.reduce((w,{frames:M})=>w+M,0)),l=[],c=0,h=!1;for(let w of e){let{metres:M,text:E}=t[l.length],T=c>0&&!w.given&&this.nearest(E)==="stand",y=T?Fv:c>0&&M===0?is:0;l.push(c),w.given&&(o.values.set(w.given.values,c*At),o.known.set(w.given.known,c*At));for(let A=c;A<c+w.passage.frames;A++)(T||A<c+Gt(y*St))&&(o.known[A*At+ae+_n]=o.known[A*At+ae+An]=+(A>=c+Gt(y*St)));h||=T||!!w.given,c+=w.passage.frames}let u=await this.ledDown(o,t,l,s);t[0].held&&o.known.fill(1,0,a[0].frames*At);let f=await wi(this.sampler,a,s,{...r,constraint:h||u?o:null,window:this.window(),overlap:t.some(({count:w})=>w>1)?jm:Ds});for(let[w,M]of t.entries())if(M.meanwhile){let E=Ou([M.side==="both"?"arms":`${M.side}-arm`]),T=Uu(f,l[w],l[w]+a[w].frames,E);f=await al(this.sampler,M.meanwhile,T,s)}for(let[w,M]of t.entries())M.degrees===null&&M.metres===null&&mu(f,this.steady(M.text,t.length===1),l[w],l[w]+a[w].frames);let d=t.map(w=>this.pace(w)),p=a.map(({frames:w},M)=>Math.ceil(w/d[M])),_=t.map((w,M)=>gu(He(f,l[M],l[M]+a[M].frames),d[M]));Math.max(...d)>1&&(f=On(_));let m=p.map((w,M)=>p.slice(0,M).reduce((E,T)=>E+T,0)),g=Ns(f,this.settings.post,{text:n}),x=this.rested(g,[t[0].text,t.at(-1).text],t.at(-1).held);for(let[w,{count:M,text:E}]of t.entries())if(this.nearest(E)==="clap"&&!t[w].meanwhile)x=sl(x,m[w],m[w]+p[w]);else if(M>1&&this.byArms(E)&&!(this.nearest(E)in tl)){let T=Array.from({length:M-1},(y,A)=>Math.floor(p[w]*(A+1)/M));x=Ru(x,T.map(y=>m[w]+y))}return{...x,text:n}}async ledDown(t,e,n,s){let r=({text:o})=>mr.includes(this.nearest(o)),a=!1;for(let o=1;o<e.length;o++){let l=e.slice(o-1,o+1),c=[];if(!l.some(r))continue;for(let{text:d}of l)c.push((await pr(this.sampler,d,s)).height);let h=c[1]-c[0],u=Math.max(n[o]-zv,1),f=Math.min(Gt(Math.abs(h)/kv*St),ge(t.values)-u);if(!(Math.abs(h)<Bv)){for(let d=0;d<f;d++){let p=f>1?d/(f-1):0,_=(u+d)*At+ae+ya;t.known[_]||(t.values[_]=c[0]+h*p**3*(10-15*p+6*p*p)),t.known[_]=1}a=!0}}return a}window(){return Math.min(rl,Math.max(2*Ds,Gt((this.settings.maxSeconds??rl/St)*St)))}async stretch(t,e,n,s=null){s!==null&&(t={...t,seconds:s/St});let{text:r,count:a}=t,o=this.beginsStanding(r);t.steps!==null&&t.seconds===null&&(t={...t,seconds:await this.stepping(t,n)});let l=this.pace(t);e=(t.seconds??e)*l,s&&=s*l;let c=u=>({passage:{text:r,frames:ge(u.values),afresh:o},given:u});if(this.applauds(t)&&!await this.turns(t)){let u=Math.max(1,Gt(e/Ov)),f=Math.max(1,Gt(e/l*St))*l;if(u>1)return this.repeated({...t,count:u},pl,e,f);if(!t.held)return{passage:{text:pl,frames:f,afresh:this.beginsStanding(pl),miss:this.miss(t,f)}}}if(await this.turns(t))return c(await this.turn(t,e,n));if(t.metres===0){let u=ti(Math.max(1,Gt(e*St)));for(let f=ae;f<u.values.length;f+=At)u.known[f+_n]=u.known[f+An]=1;return c(u)}if(t.metres!==null){let u=await pr(this.sampler,r,n),f=t.seconds===null?null:Math.max(t.seconds*St-1,1)/St,d=_=>Fu([[0,0],[0,t.metres]],{...u,seconds:_}),p;try{p=d(f)}catch(_){if(s!==null)throw _;p=d(null)}return c(zu(ku(p,await this.sway(r,p.points.length,n))))}if(a>1)return this.repeated(t,r,e,s);let h=Math.max(1,Gt(e*St));return t.held?c(await this.held(t,h,n)):{passage:{text:r,frames:h,afresh:o,miss:this.miss(t,h)}}}isSingle({text:t,held:e}){let n=this.nearest(t);return n in tl&&n!=="clap"&&!e&&!this.reader.saysOften(t)}applauds({text:t,count:e,metres:n}){if(this.nearest(t)!=="clap"||e>1||n!==null)return!1;let s=this.reading(pl);return s.action==="clap"&&s.certainty>0&&!this.reader.saysNumber(t)}pace(t){return this.nearest(t.text)==="clap"&&t.metres===null&&t.degrees===null&&(t.count>1||this.applauds(t))?Xv:1}repeated(t,e,n,s){let{count:r}=t,a=s!==null?Math.ceil(s/r):Gt(Math.min(Math.max(n/r,dl[0]),dl[1])*St),o=s??a*r;return{passage:{text:e,frames:o,afresh:this.beginsStanding(e),window:a+jm,miss:this.miss(t,o)}}}async turns({degrees:t,metres:e,count:n,text:s}){return t!==null||this.nearest(s)==="spin"?!0:this.nearest(s)==="turn"&&this.reader.sideOf(s)!=="both"?!this.reader.turnsHead(s):e===null&&n===1&&await this.bend(s)!==0}async stepping({steps:t,text:e},n){if(!Ym.includes(this.nearest(e)))return null;let{speed:s}=await pr(this.sampler,e,n);return t*Math.sqrt(60*Rv/s)}async bend(t){let e=this.reader.sideOf(t),n=this.reader.goesRound(t);if(!Ea.includes(this.nearest(t))||!(n||e!=="both"))return 0;if(!this.bent.has(t)){let{turning:s}=await pr(this.sampler,t,0),r=e==="both"?s>0:e==="left",a=n?360:Math.abs(s)<Iv?0:Zu;this.bent.set(t,r?a:-a)}return this.bent.get(t)}async turn({degrees:t,text:e,count:n,seconds:s},r,a){let o=this.nearest(e)==="turn",l=this.reader.sideOf(e);if(t!==null){let d=Aa(t,s??void 0);return o?tg(d):d}if(o&&l!=="both"){let d=Zu*n*(l==="left"?1:-1);return tg(n>1?Aa(d,s??void 0):Aa(d,r,Math.max((r-Pv)/2,is)))}let c=await this.bend(e);if(c&&s===null&&(r=Math.max(r,Math.abs(c)/Jm+2*is)),c){let d=Math.abs(c)===Zu?Aa(c,r,Math.max((r-Cv)/2,is)):Zv(c,r);for(let[p,_]of(await this.sway(e,ge(d.values),a)).entries())d.values[p*At+ae+Ve]+=_;return d}let h=360/Jm,u=n;u<=1?u=Math.max(Gt((r-2*is)/h),1):s===null&&(r=u*h+2*is);let f=l==="both"?BigInt(a)%2n===0n:l==="left";return Aa(360*(f?u:-u),r)}async held(t,e,n){let{text:s}=t,r=Math.min(e,Gt(Uv*St)),a={text:s,frames:r,afresh:this.beginsStanding(s),miss:this.miss(t,r)};return Rm(await wi(this.sampler,[a],n),e)}async sway(t,e,n){return Bu(await wi(this.sampler,[{text:t,frames:e}],n))}nearest(t){return t?this.scope.check(t).nearest[0]??null:null}byArms(t){return this.scope.meta.arms.includes(this.nearest(t))}steady(t,e=!0){return e&&this.scope.meta.still?.includes(this.nearest(t))?[_n,An,Ve]:this.byArms(t)?[Ve]:[]}rested(t,e,n=!1){let s=e.map(r=>this.nearest(r));return s.some(r=>this.scope.meta.gestures.includes(r))&&(t=Ru(t,null,n)),String(s)==="clap"?sl(t):t}wanted(t){let e=this.nearest(t),{checked:n,arms:s}=this.scope.meta;if(e===null)return null;let r=cm(e,this.reader.sideOf(t),s.includes(e)),a=[...n.includes(e)?[lm[e]]:[],...r?[r]:[]];return a.length?o=>a.every(l=>l(o)):null}does(t,e){let n=this.wanted(t);return n===null||e.frames/St<Km||n(Qo(e))}miss(t,e){let n=this.wanted(t.text),s=this.nearest(t.text),r=this.reader.sideOf(t.text);if(s===null||e<Km*St)return null;let a=this.scope.meta.gestures.includes(s),o=this.window(),l=e<1/0?this.pace(t):1;return n===null&&!a?null:c=>{let h=l>1?sl(Ns(gu(c,l),this.settings.post,{})):ts(c),u=Qo(h),f=ge(c),d=t.count>1||e<=dl[1]*St&&this.isSingle(t)?hm(s,u,r):null,p=+(n!==null&&!n(u));return p&&f>o&&(p=+!n(Qo(Ns(He(c,f-o,f),this.settings.post,{})))),d!==null&&(p=Math.abs(d-Gt(t.count*f/e))),p+Gv*Number(a&&f>=e&&!jo(h))}}unseen(t){let[{text:e},...n]=this.reader.clauses(t);return n.length?null:this.miss(gr(e),1/0)}async alongPath({blocks:t,path:e},n,s){let r=t.length===1,a=this.passages(t),o=await pr(this.sampler,t[0].text,n),l=a.reduce((d,{frames:p})=>d+p,0),c=Fu(e,{...o,seconds:r?t[0].seconds:(l-1)/St});a[a.length-1].frames+=c.points.length-l;let h=Bu(await wi(this.sampler,a,n,{...s,told:void 0})),u=zu(ku(c,h)),f=await wi(this.sampler,a,n,{...s,constraint:u});return Ns(f,this.settings.post,{known:u.known,text:a.map(({text:d})=>d).join(", then "),place:{x:c.points[0][0],z:c.points[0][1],heading:c.headings[0]},carried:!0})}async edited({blocks:t,clip:e},n,s){let r=t.map(m=>m.text).join(", then "),{motion:a,mode:o}=e,l=t.reduce((m,g)=>m+g.seconds,0),c=Gt(e.keep*St),h;if(o==="redo"){let m=Gt(e.from*St),g=Math.min(Gt(e.until*St),a.frames);if(!(m>=0&&m<g))throw new Error(`The clip lasts ${(a.frames/St).toFixed(2)} seconds; choose a span of it.`);h=Am(a,m,g,e.joints.length?Ou(e.joints):null)}else{let m=o==="between"?2:1,g=Gt(l*St)+m*c;if(a.frames<c)throw new Error(`The clip lasts ${(a.frames/St).toFixed(2)} seconds, less than the ${e.keep} to be kept.`);let x=o==="between"?a:Ju(a,a.frames-c,a.frames);h=Tm(x,o==="between"?e.second??a:null,c,g,o==="between"&&!e.second)}let u=r?{miss:this.unseen(r)}:{guidance:0},f=r&&this.reader.whole(r,this.reader.clauses(r)),{features:d,known:p}=await Cm(this.sampler,f||Em,h,n,{...s,...u}),_=Ns(d,this.settings.post,{known:p,text:r,place:h.place});return{..._,missed:r?this.unlessShown(r,_,h.constraint.known):null}}unlessShown(t,e,n){let s=[...Array(e.frames).keys()].filter(o=>He(n,o,o+1).includes(0)),[{text:r},...a]=this.reader.clauses(t);return!s.length||a.length||this.does(r,Ju(e,s[0],s.at(-1)+1))?null:`“${t}”: what was made anew does not show “${this.nearest(r)}”, by how joints move; look at it, try a longer span, another seed, or a clip that stands.`}};function Yv(i,t,e,n){let s=i.frames-e,r=[],a=(o,l)=>i.contacts[(s+o)*2+l]>.5;for(let o=1;o<e;o++)o>=.5*n/t&&[0,1].some(l=>a(o,l)&&!a(o-1,l))&&r.push(o);return r.length>=t&&(n=Math.min(r[t-1]+Gt(qv*i.fps),e)),Ju(i,0,s+n)}var Ju=(i,t,e)=>({...i,frames:e-t,quaternions:i.quaternions.slice(t*88,e*88),root:i.root.slice(t*3,e*3),contacts:i.contacts.slice(t*2,e*2)});function tg(i){let t=0;for(;!i.values[t*At+ae+Ve];)t++;for(;t<ge(i.values);t++)for(let e of[_n,An])i.values[t*At+ae+e]=0,i.known[t*At+ae+e]=1;return i}function Zv(i,t){let e=ti(Gt(t*St));for(let n=0;n<ge(e.values);n++)e.values[n*At+ae+Ve]=i*Math.PI/180/t,e.known[n*At+ae+Ve]=1;return e}function Aa(i,t=Math.max(Math.abs(i)/Nv,1)+2*is,e=is){let n=Gt(Math.min(e,t/4)*St),s=Math.max(Gt(t*St)-2*n,1),r=ti(s+2*n),a=o=>i*Math.PI/180*(3*(o/s)**2-2*(o/s)**3);for(let o=0;o<s+2*n;o++){let l=o-n,c=o*At+ae+Ve;l>=0&&l<s&&(r.values[c]=(a(l+1)-a(l))*St),r.known[c]=1}return r}var gl=class{constructor(t,e,n){Object.assign(this,{denoiser:t,tower:e,settings:n})}async sample(t,e,n,s=null,r=this.settings.guidance){let{mean:a,std:o,schedule:l,nullText:c,tags:h,shifted:u}=this.settings,f=u.length>0,d=e*At,p=Sm(n,t,d),_=new Uint8Array(d),m=s?s.shown.map((y,A)=>y&&s.known[A]):_,g=new Float32Array(d);if(s)for(let y=0;y<d;y++)s.known[y]&&(g[y]=(s.values[y]-a[y%At])/o[y%At]);let x=this.tower.encode(t),w=this.opened(x),M=p.slice(),E=null;for(let y=0;y<l.length;y++){let[A,F]=l[y],N=y+1<l.length?l[y+1][1]:1,D=Math.sqrt(F),B=Math.sqrt(1-F),Z=M;if(s){Z=M.slice();for(let W=0;W<d;W++)s.known[W]&&(Z[W]=m[W]?g[W]:D*g[W]+B*p[W])}let P=await this.guided(Z,A,x,c,h,m,f?Math.min(r,1):r,w,f&&y===0),$=this.cleaned(M,P,D,B,s?.known,g),Q={clean:$,lambda:Math.log(D/B)};M=Kv(M,this.settings.sampler==="ddim"?$:Jv(Q,E,N),D,B,N),E=Q}let T=new Float32Array(d);for(let y=0;y<d;y++)T[y]=s?.known[y]?s.values[y]:M[y]*o[y%At]+a[y%At];return T}opened(t){let{adapters:e}=this.settings;if(!e)return 0;let{places:n,adapterOf:s}=e,r=t.length,a=0,o=-1/0;for(let l=0;l<s.length;l++){let c=0;for(let h=0;h<r;h++)c+=n[l*r+h]*t[h];c>o&&([a,o]=[l,c])}return Number(s[a])}async guided(t,e,n,s,r,a,o,l,c){if(o===1||o===0)return(await this.denoiser.predict([t],e,[o?n:s],r,a,l,c))[0];let[h,u]=await this.denoiser.predict([t,t],e,[n,s],r,a,l);return h.map((f,d)=>u[d]+o*(f-u[d]))}cleaned(t,e,n,s,r,a){let{clip:o,prediction:l}=this.settings;return t.map((c,h)=>{let u=e[h];return r?.[h]?u=a[h]:l==="epsilon"?u=(c-s*e[h])/n:l==="v"&&(u=n*c-s*e[h]),o===null?u:Math.min(Math.max(u,-o),o)})}};function Jv({clean:i,lambda:t},e,n){if(!e||n===1)return i;let s=.5*(.5*Math.log(n/(1-n))-t)/(t-e.lambda);return i.map((r,a)=>r+s*(r-e.clean[a]))}function Kv(i,t,e,n,s){let r=Math.sqrt(1-s),a=Math.sqrt(s);return i.map((o,l)=>a*t[l]+r*(o-e*t[l])/n)}var _l=class{constructor(t,e){this.maxTokens=e,this.pieces=new Map,this.bytes=[],this.longest=1;let n=0,s=0,r=new Uint8Array;for(let[a,o]of Ku(t)){if(a===3&&(r=o),a!==1)continue;let l="",c=0,h=1;for(let[u,f]of Ku(o))u===1&&(l=new TextDecoder().decode(f)),u===2&&(c=f),u===3&&(h=f);h===6&&(this.bytes[parseInt(l.slice(3,5),16)]=s),(h===1||h===4||h===5)&&(this.pieces.set(l,{id:s,score:c}),this.longest=Math.max(this.longest,[...l].length),n=Math.min(n,c)),s++}this.unknown=Math.fround(n-10);for(let[a,o]of Ku(r))if(a===2){let l=new DataView(o.buffer,o.byteOffset).getUint32(0,!0);this.trie=new Uint32Array(o.slice(4,4+l).buffer),this.replacements=o.subarray(4+l)}}encode(t){let e=[0,...this.best([...this.normalized(t)]),2];return e.length>this.maxTokens?[...e.slice(0,this.maxTokens-1),2]:e}normalized(t){let e=new TextEncoder().encode(t),n=[];for(let r=0;r<e.length;){let a=0,o=-1;if(this.trie){let l=eg(this.trie[0]);for(let c=r;c<e.length;c++){l^=e[c];let h=this.trie[l];if(h===void 0||(h&2147483903)>>>0!==e[c])break;l^=eg(h),h>>>8&1&&(a=c+1-r,o=this.trie[l]&2147483647)}}if(a===0)a=e[r]<128?1:e[r]<224?2:e[r]<240?3:4,n.push(...e.subarray(r,r+a));else for(let l=o;this.replacements[l];l++)n.push(this.replacements[l]);r+=a}return new TextDecoder().decode(Uint8Array.from(n)).split(" ").filter(Boolean).map(r=>"▁"+r).join("")}best(t){let e=[0],n=[0],s=[[]],r=(o,l,c,h)=>{let u=Math.fround(e[o]+c);(e[l]===void 0||u>e[l])&&(e[l]=u,n[l]=o,s[l]=h)};for(let o=0;o<t.length;o++){let l=!1;for(let c=1,h="";c<=this.longest&&o+c<=t.length;c++){h+=t[o+c-1];let u=this.pieces.get(h);u&&(r(o,o+c,u.score,[u.id]),l||=c===1)}if(!l){let c=[...new TextEncoder().encode(t[o])];r(o,o+1,this.unknown,c.map(h=>this.bytes[h]??3))}}let a=[];for(let o=t.length;o>0;o=n[o])a.unshift(s[o]);return a.flat()}},eg=i=>i>>>10<<((i&512)>>>6);function*Ku(i){let t=new DataView(i.buffer,i.byteOffset,i.byteLength),e=0,n=()=>{let s=0,r=1,a;do a=i[e++],s+=(a&127)*r,r*=128;while(a&128);return s};for(;e<i.length;){let s=n(),r=s&7;if(r===0)yield[s>>>3,n()];else if(r===5)yield[s>>>3,t.getFloat32(e,!0)],e+=4;else if(r===1)yield[s>>>3,t.getFloat64(e,!0)],e+=8;else{let a=n();yield[s>>>3,i.subarray(e,e+a)],e+=a}}}var yl=class i{static async open(t,e){$o(t.skeleton);let n=new Rs(e.weights),s=new hl(n,new _l(e.tokenizer,t.maxTokens)),r=new or(e,t.weights,t.shifted),a={...t,mean:n.floats("statistics.mean"),std:n.floats("statistics.std"),nullText:n.floats("denoiser.null_pooled"),adapters:t.adapters&&{places:n.floats("denoiser.places"),adapterOf:n.raw("denoiser.adapter_of",BigInt64Array)}},o=new fl(t.scope,new Rs(e.scope),s);return new i(new ml(new gl(r,s,a),o,a))}constructor(t){this.director=t}make({scene:t,seed:e},n){return this.director.make(t,e,n)}warning({text:t}){return this.director.warning(t)}};function ng(i){let t=ju();i.onmessage=async({data:e})=>{let{id:n,call:s,...r}=e;try{let a=await t(s,r,o=>i.postMessage({id:n,progress:o}));i.postMessage({id:n,result:a})}catch(a){i.postMessage({id:n,error:String(a?.message??a)})}}}function ju(){let i=null;return async(t,e,n)=>t==="prepare"?(jv(e),null):t==="open"?(i=await yl.open(e.settings,e.parts),null):t==="help"?(Qv(e),null):t==="helper"?(i.director.sampler.denoiser.helper=tM(e.port),null):i[t](e,n)}function jv({settings:i,texts:t}){let e=new _r(i.measures,()=>({action:null,certainty:-1/0,arms:!1}));for(let n of[...t,...t])e.clauses(n)}function Qv({parts:i,names:t,port:e}){let n=new or(i,t);n.session(i.adapted?"adapted":"graph").catch(()=>null),e.onmessage=async({data:{id:s,args:r}})=>{try{e.postMessage({id:s,result:await n.predict(...r)})}catch(a){e.postMessage({id:s,error:String(a)})}}}function tM(i){let t=new Map,e=0;return i.onmessage=({data:{id:n,result:s,error:r}})=>{let{resolve:a,reject:o}=t.get(n);t.delete(n),r?o(new Error(r)):a(s)},(...n)=>new Promise((s,r)=>{t.set(++e,{resolve:s,reject:r}),i.postMessage({id:e,args:n})})}var eM=180/Math.PI;function ig(i){let{parents:t,names:e,offsets:n}=_e,s=nM(),r=c=>(Math.round(c*1e5)/1e5+0).toFixed(5).replace(/^-0\.00000$/,"0.00000"),a=["HIERARCHY"],o=(c,h)=>{let u="	".repeat(h),f=c?n[c].map(p=>p*100):[0,0,0];a.push(`${u}${c?"JOINT":"ROOT"} ${e[c]}`,`${u}{`,`${u}	OFFSET ${f.map(r).join(" ")}`),a.push(`${u}	CHANNELS ${c?"3":"6 Xposition Yposition Zposition"} Zrotation Xrotation Yrotation`);let d=s.filter(p=>t[p]===c);for(let p of d)o(p,h+1);for(let[p,_]of _e.tips)p===c&&a.push(`${u}	End Site`,`${u}	{`,`${u}		OFFSET ${_.map(m=>r(m*100)).join(" ")}`,`${u}	}`);a.push(`${u}}`)};o(0,0),a.push("MOTION",`Frames: ${i.frames}`,`Frame Time: ${(1/i.fps).toFixed(8)}`);let l=Array.from({length:$t},()=>[0,0,0]);for(let c=0;c<i.frames;c++){let h=l.map((f,d)=>iM(je(i.quaternions,(c*$t+d)*4),f,c===0));l=h;let u=[0,1,2].map(f=>i.root[c*3+f]*100);for(let f of s)u.push(...h[f].map(d=>d*eM));a.push(u.map(f=>f.toFixed(5)).join(" "))}return`${a.join(`
`)}
`}function nM(){let i=[],t=[0];for(;t.length;){let e=t.pop();i.push(e);for(let n=$t-1;n>0;n--)_e.parents[n]===e&&t.push(n)}return i}function iM(i,t,e){let n=Math.hypot(i[1],i[4]),s=n<1e-8,r=s?t[0]:Math.atan2(-i[1],i[4]),a=Math.atan2(i[7],n),o=(u,f)=>[u,f,Math.atan2(Math.cos(u)*i[2]+Math.sin(u)*i[5],Math.cos(u)*i[0]+Math.sin(u)*i[3])].map((d,p)=>d-2*Math.PI*Math.round((d-t[p])/(2*Math.PI))),l=o(r,a),c=o(r+Math.PI,Math.PI-a),h=u=>u.reduce((f,d,p)=>f+Math.abs(d-t[p]),0);return!e&&!s&&h(c)<h(l)?c:l}var sg=1313821514,rg=5130562;function Qu(i){let t=new DataView(i.buffer,i.byteOffset,i.byteLength);if(i.length<20||t.getUint32(0,!0)!==1179937895)throw new Error("This is no GLB file.");let e={document:null,data:new Uint8Array};for(let n=12;n+8<=i.length;){let s=t.getUint32(n,!0),r=t.getUint32(n+4,!0),a=i.subarray(n+8,n+8+s);r===sg&&(e.document=JSON.parse(new TextDecoder().decode(a))),r===rg&&(e.data=a),n+=8+s}if(!e.document)throw new Error("This is no whole GLB file.");return e}function ag(i,t){let{document:e,data:n}=Qu(t),{frames:s,fps:r}=i,[a]=e.animations,o=new Map,l=(d,p)=>o.set(d,p);for(let{sampler:d,target:p}of a.channels){let{input:_,output:m}=a.samplers[d];if(l(_,Float32Array.from({length:s},(x,w)=>w/r)),p.path==="translation"){l(m,i.root.slice());continue}let g=new Float32Array(s*4);for(let x=0;x<s;x++)g.set(i.quaternions.subarray((x*$t+p.node)*4,(x*$t+p.node)*4+4),x*4);Dn(g,4);for(let x=0;x<g.length;x+=4)g.copyWithin(x,x,x+4),g.set([g[x+1],g[x+2],g[x+3],g[x]],x);l(m,g)}let c=[],h=0;e.bufferViews.forEach((d,p)=>{let _=e.accessors.findIndex(({bufferView:x})=>x===p),m=o.get(_),g=m?new Uint8Array(m.buffer):n.subarray(d.byteOffset,d.byteOffset+d.byteLength);h+=-h&3,Object.assign(d,{byteOffset:h,byteLength:g.length}),c.push([h,g]),h+=g.length,m&&Object.assign(e.accessors[_],{count:s}),m&&e.accessors[_].max&&Object.assign(e.accessors[_],{min:[0],max:[m[s-1]]})});let u=i.text||"motion";Object.assign(e.scenes[0],{name:u,extras:{text:i.text}}),a.name=u;let f=new Uint8Array(h);for(let[d,p]of c)f.set(p,d);return e.buffers[0].byteLength=h,sM(new TextEncoder().encode(JSON.stringify(e)),f)}function sM(i,t){let e=[i.length+(-i.length&3),t.length+(-t.length&3)],n=new Uint8Array(28+e[0]+e[1]).fill(32,20,20+e[0]),s=new DataView(n.buffer);return[1179937895,2,n.length,e[0],sg].forEach((r,a)=>s.setUint32(a*4,r,!0)),n.set(i,20),s.setUint32(20+e[0],e[1],!0),s.setUint32(24+e[0],rg,!0),n.set(t,28+e[0]),n}var Ta=[1,0,0,0,1,0,0,0,1],ug=.7,og=[.45,.8],rM=200,aM=18e3,oM=.01,lM=.001,cM=2e-5,hM=1e-4,uM=.15,fM=1.2,dM={spine1:"spine2",neck:"head",l_collar:"l_shoulder",r_collar:"r_shoulder",l_shoulder:"l_elbow",r_shoulder:"r_elbow",l_elbow:"l_wrist",r_elbow:"r_wrist",l_hip:"l_knee",r_hip:"r_knee",l_knee:"l_ankle",r_knee:"r_ankle",l_ankle:"l_foot",r_ankle:"r_foot"},lg={l_wrist:"l_elbow",r_wrist:"r_elbow"},pM={l_foot:.02,r_foot:.02,l_knee:.04,r_knee:.04,pelvis:.08,spine3:.1,head:.08,l_elbow:.03,r_elbow:.03,l_wrist:.02,r_wrist:.02},cg=["spine1","spine2","spine3","neck","l_collar","r_collar","l_foot","r_foot"];function sf(i,t){let{joints:e,axes:n}=mM(i.names,t),s=Math.max(1,Math.round(i.fps/St));if(s>1&&Math.abs(i.fps/s-St)<oM*St&&(i=MM(i,s)),i.frames/i.fps*St>aM)throw new Error("The clip is longer than ten minutes; split it.");if(i.frames<2)throw new Error("The clip has one frame only.");let r=xM(i,e);if(!r&&!Object.keys(n).length)throw new Error("Its rest pose is no standing body. Bring it onto our skeleton first: motion-tools convert CLIP a.npz, then a.npz a.bvh.");let a=yM(i,e),o=gM(i,e);if(!(o>1e-6))throw new Error("Its legs have no length.");let l=a?Ta:bM(i.up??wM(i,e,r)),c=a?jt(_e.offsets[Ae.l_knee])/jt(i.offsets[e.l_knee]):pa/o,h=SM(i,e,vM(i,e,n,r),l,c);if(![...h.quaternions,...h.root].every(Number.isFinite))throw new Error("It holds numbers that are none.");return!a&&_M(i,e,o)&&mg(h).forEach((u,f)=>{h.root[f*3+1]-=u}),a||(h=EM(h)),TM(AM(h),!a)}var tf=i=>i.replace(/^.*[:|]/,"").replace(/^mixamorig\d*/i,"").replace(/[^\p{L}\p{N}]/gu,"").toLowerCase();function mM(i,t){let e=new Map,n=new Map;for(let u of i){let f=/^[^ _.\-]+[ _.\-]/.exec(u)?.[0];f&&n.set(f,(n.get(f)??0)+1)}let[s,r]=[...n].sort((u,f)=>f[1]-u[1])[0]??["",0];i.forEach((u,f)=>{let d=p=>{e.has(p)||e.set(p,f)};d(tf(u)),r>=.8*i.length&&u.startsWith(s)&&d(tf(u.slice(s.length)))});let a=t.map(u=>{let f={},d={};for(let[p,_]of Object.entries(u.joints)){let m=i.indexOf(_),g=m>=0?m:e.get(tf(_));g!==void 0&&(f[p]=g,u.axes[_]&&(d[p]=u.axes[_]))}return{joints:f,axes:d,whole:Object.keys(f).length===Object.keys(u.joints).length,size:Object.keys(u.joints).length}}),o=a.find(u=>u.whole);if(o)return o;let l=({joints:u})=>_e.names.filter(f=>!cg.includes(f)&&f in u).length,c=_e.names.length-cg.length,[h]=[...a].sort((u,f)=>l(f)-l(u)||Object.keys(f.joints).length-Object.keys(u.joints).length||u.size-f.size);if(l(h)<c)throw new Error("Its joints have names the studio does not know. Bring it onto our skeleton first: motion-tools convert CLIP a.npz, then a.npz a.bvh.");return h}function fg(i,t,e){let n=[];for(;e!==t&&e>=0;)n.push(e),e=i.parents[e];return e===t?n:[]}var ef=(i,t,e)=>fg(i,t,e).reduce((n,s)=>Ee(n,i.offsets[s]),[0,0,0]);function gM(i,t){let e=["l","r"].map(n=>jt(ef(i,t[`${n}_hip`],t[`${n}_knee`]))+jt(ef(i,t[`${n}_knee`],t[`${n}_ankle`])));return(e[0]+e[1])/2}function _M(i,t,e){return fg(i,t.pelvis,t.head).reduce((s,r)=>s+jt(i.offsets[r]),0)>fM*e}function yM(i,t){if(Object.keys(t).length<$t)return!1;let e=jt(_e.offsets[Ae.l_knee])/Math.max(jt(i.offsets[t.l_knee]),1e-12);return _e.names.every((n,s)=>s===0||i.parents[t[n]]===t[_e.names[_e.parents[s]]]&&i.offsets[t[n]].every((r,a)=>Math.abs(r*e-_e.offsets[s][a])<hM))}function xM(i,t){let e=[];i.parents.forEach((l,c)=>e.push(l<0?i.offsets[c]:Ee(e[l],i.offsets[c])));let n=l=>e[t[l]],s=Ee(Pe(n("l_hip"),n("r_hip")),Pe(n("l_shoulder"),n("r_shoulder"))),r=[Pe(n("head"),n("pelvis"))];for(let l of"lr")r.push(Pe(n(`${l}_hip`),n(`${l}_knee`)),Pe(n(`${l}_knee`),n(`${l}_ankle`)));if([s,...r].some(l=>jt(l)<1e-9))return null;let a=r.reduce((l,c)=>Ee(l,Le(Ge(c),1/r.length)),[0,0,0]),o=[];for(let l of[Ge(s),a]){let c=l.map(Math.abs),h=c.indexOf(Math.max(...c));if(c[h]<ug)return null;o.push([0,1,2].map(u=>u===h?Math.sign(l[h]):0))}return r.some(l=>li(l,o[1])<.5*jt(l))||li(o[0],o[1])?null:[...o[0],...o[1],...Li(o[0],o[1])]}function vM(i,t,e,n){let s={},r={};for(let a of _e.names){if(!(a in t))continue;let o=n??e[a]??Ta,l=dM[a],c=Ta;if(l in t){let h=Ye(o,ef(i,t[a],t[l]));jt(h)>1e-6&&(c=dg(h,_e.offsets[Ae[l]]))}else a in lg&&(c=s[lg[a]]??c);s[a]=c,r[a]=ci(be(c,o))}return r}function dg(i,t){let e=Ge(i),n=Ge(t),s=Li(e,n),r=li(e,n);if(r<-.999999){let l=e.map(Math.abs),c=[0,0,0];c[l.indexOf(Math.min(...l))]=1;let h=Ge(Li(e,c));return je([0,...h])}let a=[0,-s[2],s[1],s[2],0,-s[0],-s[1],s[0],0],o=be(a,a);return Ta.map((l,c)=>l+a[c]+o[c]/(1+r))}var MM=(i,t)=>({...i,frames:Math.ceil(i.frames/t),fps:i.fps/t,rotation:(e,n)=>i.rotation(e*t,n),translation:(e,n)=>i.translation(e*t,n)});function pg(i,t){let e=[],n=[];return i.parents.forEach((s,r)=>{let a=i.translation(t,r),o=i.rotation(t,r);e.push(s<0?a:Ee(e[s],Ye(n[s],a))),n.push(s<0?o:be(n[s],o))}),{positions:e,rotations:n}}var nf={X:[1,0,0],Y:[0,1,0],Z:[0,0,1],"-X":[-1,0,0],"-Y":[0,-1,0],"-Z":[0,0,-1]};function hg(i){let t=i.map(Math.abs),e=t.indexOf(Math.max(...t));return(i[e]>0?"":"-")+"XYZ"[e]}function wM(i,t,e){let n=Math.max(1,Math.floor(i.frames/rM)),s=[],r=[],a=[0,0,0],o=0;for(let h=0;h<i.frames;h+=n,o++){let{positions:u}=pg(i,h),f=Pe(u[t.head],Le(Ee(u[t.l_ankle],u[t.r_ankle]),.5));s.push(jt(f)),r.push(u[t.pelvis]),a=Ee(a,Le(f,1/Math.max(jt(f),1e-9)))}a=Le(a,1/o);let l=Math.max(...a.map(Math.abs))>ug?hg(a):null,c=e&&hg(e.slice(3,6));if(l&&c&&c!==l){let h=Rn(r.map(u=>li(u,nf[l])),50)/Rn(s,50);h>og[0]&&h<og[1]||(l=null)}return l??c??"Y"}function bM(i){return i==="Y"?Ta:i==="-Y"?[1,0,0,0,-1,0,0,0,-1]:dg(nf[i],nf.Y)}function SM(i,t,e,n,s){let{names:r,parents:a}=_e,o=new Float32Array(i.frames*$t*4),l=new Float32Array(i.frames*3),c=Le(Ee(_e.offsets[Ae.l_hip],_e.offsets[Ae.r_hip]),.5),h=r.map((u,f)=>r.map((d,p)=>p).filter(d=>a[d]===f));for(let u=0;u<i.frames;u++){let{positions:f,rotations:d}=pg(i,u),p=r.map(m=>m in t?be(n,be(d[t[m]],e[m])):null);r.forEach((m,g)=>{if(p[g])return;let[x]=h[g],w=p[a[g]],M=h[g].length===1&&p[x];p[g]=M?je(Ni(gn(w),gn(p[x]),.5)):w});let _=Ye(n,Le(Ee(f[t.l_hip],f[t.r_hip]),.5));l.set(Pe(Le(_,s),Ye(p[0],c)),u*3),r.forEach((m,g)=>{let x=g?be(ci(p[a[g]]),p[g]):p[0];o.set(gn(x),(u*$t+g)*4)})}return Dn(o,$t*4),{frames:i.frames,quaternions:o,root:l,contacts:new Float32Array(i.frames*2),fps:i.fps,text:""}}function EM(i){if(i.frames<3)return i;let[t,e]=[0,1].map(n=>{let s=0;for(let r=0;r<$t;r++){let[a,o]=[(n*$t+r)*4,((n+1)*$t+r)*4],l=0;for(let c=0;c<4;c++)l+=i.quaternions[a+c]*i.quaternions[o+c];s+=2*Math.acos(Math.min(Math.abs(l),1))}return s/$t});return t<uM||t<5*e?i:{...i,frames:i.frames-1,quaternions:i.quaternions.slice($t*4),root:i.root.slice(3),contacts:i.contacts.slice(2)}}function AM(i){if(Math.abs(St/i.fps-1)<lM)return{...i,fps:St};let t=i.frames-1,e=t/i.fps*St,n=Math.floor(e+Math.min(cM*e,.5)+1e-6)+1,s=new Float32Array(n*$t*4),r=new Float32Array(n*3);for(let a=0;a<n;a++){let o=Math.min(a*i.fps/St,t),l=Math.min(Math.floor(o),t-1),c=o-l;for(let h=0;h<$t;h++){let[u,f]=[(l*$t+h)*4,((l+1)*$t+h)*4];s.set(Ni(Array.from(i.quaternions.subarray(u,u+4)),Array.from(i.quaternions.subarray(f,f+4)),c),(a*$t+h)*4)}for(let h=0;h<3;h++)r[a*3+h]=i.root[l*3+h]+c*(i.root[l*3+3+h]-i.root[l*3+h])}return{...i,frames:n,quaternions:Dn(s,$t*4),root:r,contacts:new Float32Array(n*2),fps:St}}function mg(i){return Array.from({length:i.frames},(t,e)=>{let{positions:n}=En(i,e);return Math.min(...Object.entries(pM).map(([s,r])=>n[Ae[s]][1]-r))})}function TM(i,t){let e=Array.from({length:i.frames},(a,o)=>En(i,o).positions),n=t?-Rn(mg(i),2):0,s=i.root.slice(),r=new Float32Array(i.frames*2);for(let a=0;a<i.frames;a++)s[a*3+1]+=n;return ma.forEach(({ball:a},o)=>{let l=e.map((c,h)=>{let u=Math.max(Math.min(h,i.frames-2),0),f=jt(Pe(e[u+1][a],e[u][a]))*i.fps;return+(c[a][1]+n<Qn+.06&&f<.35)});l.forEach((c,h)=>{r[h*2+o]=+((l[h-1]??c)+c+(l[h+1]??c)>=2)})}),{...i,root:s,contacts:r}}var xl=1e3,RM=1e7,yg=2e3,CM=1e6,PM=.001,xg=[1,0,0,0,1,0,0,0,1],gg="This animation is stored in a way the studio does not read.";function vg(i,t,e){try{if(/\.(glb|vrma)$/i.test(i))return sf(LM(t),e);if(/\.bvh$/i.test(i))return sf(IM(new TextDecoder().decode(t)),e)}catch(n){throw n.constructor===Error?n:new Error("This file is damaged; export it again.")}throw new Error("Only .bvh, .glb and .vrma can be opened.")}function IM(i){let t=i.split(/\s+/u).filter(Boolean),e=[],n=[],s=0,r=0,a=!1;for(;s<t.length&&t[s].toUpperCase()!=="MOTION";s++){let d=t[s].toUpperCase(),p=n[n.length-1];if(d==="ROOT"||d==="JOINT")e.push({name:t[++s],parent:p?e.indexOf(p):-1,offset:[0,0,0],channels:[],column:0}),n.push(e[e.length-1]);else if(d==="END")a=!0,n.push(null);else if(d==="OFFSET"&&p&&!a)p.offset=[1,2,3].map(_=>Number(t[s+_]));else if(d==="CHANNELS"&&p){let _=Number(t[s+1]);if(!(_>=0&&_<=6))throw new Error("This BVH file is damaged.");Object.assign(p,{channels:t.slice(s+2,s+2+_).map(m=>m.toUpperCase()),column:r}),r+=_}else d==="}"&&(n.pop(),a=!1);if(e.length>xl)throw new Error(`This BVH file has more than ${xl} joints.`)}let o=Number(t[s+2]),l=1/Number(t[s+5]),c=s+6;if(s>=t.length||!(o>0&&Number.isInteger(o))||!(l>=1&&l<=yg))throw new Error("This is no whole BVH file.");if(t.length-c!==o*r)throw new Error(`This BVH file says ${o} frames, but holds ${Math.floor((t.length-c)/r)}; it is cut off or damaged.`);let h=Float64Array.from(t.slice(c),Number);if(!h.every(d=>Math.abs(d)<RM))throw new Error("This BVH file holds numbers that are no angle and no place.");let u=(d,p)=>{let{channels:_,column:m}=e[p],g=xg;return _.forEach((x,w)=>{let M={XROTATION:[1,0,0],YROTATION:[0,1,0],ZROTATION:[0,0,1]}[x],E=h[d*r+m+w]*Math.PI/360;M&&(g=be(g,je([Math.cos(E),...M.map(T=>T*Math.sin(E))])))}),g},f=(d,p)=>{let{channels:_,column:m,offset:g}=e[p];return["X","Y","Z"].map((x,w)=>{let M=_.indexOf(`${x}POSITION`);return M<0?g[w]:h[d*r+m+M]})};return{names:e.map(({name:d})=>d),parents:e.map(({parent:d})=>d),offsets:e.map(({offset:d})=>d),frames:o,fps:l,rotation:u,translation:f}}function LM(i){let{document:t,data:e}=Qu(i),{animations:n=[]}=t,s=(t.nodes??[]).map(NM);if(!n[0]?.channels.length)throw new Error("There is no animation in this file.");if(s.length>xl)throw new Error(`This file has more than ${xl} joints.`);let r=new Array(s.length).fill(-1),a=[];s.forEach(({children:E=[]},T)=>E.forEach(y=>{r[y]=T}));let o=E=>{a.push(E),(s[E].children??[]).forEach(o)};r.forEach((E,T)=>{E<0&&o(T)});let l=OM(t,e,n[0]),c=t.extensions?.VRMC_vrm_animation?.humanoid?.humanBones??{},h=new Map(Object.entries(c).map(([E,{node:T}])=>[T,E])),u=new Map(a.map((E,T)=>[E,T])),f=[],d=[],p=E=>{let[T,y,A,F]=s[E].rotation??[0,0,0,1];return je([F,T,y,A])},_=a.map(E=>r[E]<0?-1:u.get(r[E]));a.forEach((E,T)=>{let y=_[T],[A]=s[E].scale??[1];f.push(y<0?p(E):be(f[y],p(E))),d.push((y<0?1:d[y])*A)});let m=E=>_[E]<0?xg:f[_[E]],g=E=>_[E]<0?1:d[_[E]],x=(E,T)=>Ye(m(E),T).map(y=>y*g(E)),{times:w,fps:M}=DM([...l.values()].map(({times:E})=>E));return{names:a.map(E=>h.get(E)??s[E].name??""),parents:_,offsets:a.map((E,T)=>x(T,s[E].translation??[0,0,0])),frames:w.length,fps:M,up:"Y",rotation:(E,T)=>{let y=l.get(`${a[T]} rotation`),A=y?je(_g(y,w[E])):p(a[T]);return be(be(m(T),A),ci(f[T]))},translation:(E,T)=>{let y=l.get(`${a[T]} translation`);return x(T,y?_g(y,w[E]):s[a[T]].translation??[0,0,0])}}}function NM(i){if(!i.matrix)return i;let t=r=>i.matrix.slice(4*r,4*r+3),e=[0,1,2].map(r=>jt(t(r))),[n,...s]=gn(ci([0,1,2].flatMap(r=>Ge(t(r)))));return{...i,translation:t(3),rotation:[...s,n],scale:e}}function DM(i){let t=i.reduce((h,u)=>u.length>h.length?u:h),e=Math.min(...i.map(h=>h[0])),n=Math.max(...i.map(h=>h[h.length-1])),s=t.length-1;if(s<1)return{times:t,fps:St};let r=Array.from(t.subarray(1),(h,u)=>h-t[u]),a=(n-e)/s,o=t.every((h,u)=>Math.abs(h-e-u*a)<PM*a),l=1/(o?a:Rn(r,50)),c=Math.round(l*100)/100;if(Math.abs(l-c)<1e-4&&(l=c),!(l>=1&&l<=yg))throw new Error(`This file moves at ${l.toFixed(2)} frames a second.`);return{times:o?t:Array.from({length:Math.min(Math.round((n-e)*l)+1,CM)},(h,u)=>e+u/l),fps:l}}function OM(i,t,e){let n=r=>{let{bufferView:a,byteOffset:o=0,count:l,type:c,componentType:h}=i.accessors[r],u={SCALAR:1,VEC3:3,VEC4:4}[c],f=i.bufferViews[a];if(!f||h!==5126||!u||(f.byteStride??u*4)!==u*4)throw new Error(gg);let d=(f.byteOffset??0)+o;if(!(d+l*u*4<=t.length))throw new Error("This file is cut off.");return new Float32Array(t.slice(d,d+l*u*4).buffer)},s=e.channels.filter(({target:{node:r,path:a}})=>r!==void 0&&a!=="weights");return new Map(s.map(({sampler:r,target:a})=>{let{input:o,output:l,interpolation:c="LINEAR"}=e.samplers[r];if(c==="CUBICSPLINE")throw new Error(gg);return[`${a.node} ${a.path}`,{times:n(o),values:n(l),steps:c==="STEP"}]}))}function _g({times:i,values:t,steps:e},n){let s=0,r=i.length-1;for(;r-s>1;){let u=s+r>>1;i[u]<=n+1e-6?s=u:r=u}let a=r===s?0:Math.min(Math.max((n-i[s])/(i[r]-i[s]),0),1);e&&(a=Math.floor(a+1e-6));let o=t.length/i.length,l=u=>Array.from(t.subarray(u*o,u*o+o)),[c,h]=[l(s),l(r)];return o===3?c.map((u,f)=>u+a*(h[f]-u)):a<1e-6?rf(c):Ni(gn(je(rf(c))),gn(je(rf(h))),a)}var rf=([i,t,e,n])=>[n,i,t,e];var UM=["video/mp4;codecs=avc1.42E01F","video/webm;codecs=vp9","video/webm;codecs=vp8","video/webm"];async function Mg(i,t,e){let n=globalThis.MediaRecorder&&UM.find(l=>MediaRecorder.isTypeSupported(l));if(!n||!i.captureStream)throw new Error("This browser records no films.");let s=new MediaRecorder(i.captureStream(60),{mimeType:n,videoBitsPerSecond:6e6}),r=[];s.ondataavailable=({data:l})=>r.push(l);let a=new Promise(l=>{s.onstop=l});e(0),s.start();let o=performance.now();return await new Promise(l=>{let c=h=>{let u=(h-o)/1e3;e(Math.min(Math.max(u,0),t))&&u<t+.2?requestAnimationFrame(c):l()};requestAnimationFrame(c)}),s.stop(),await a,{blob:new Blob(r,{type:n.split(";")[0]}),kind:n.includes("mp4")?"mp4":"webm"}}var vl=class i{waiting=new Map;count=0;workers=[];static async open(t,e,n,s){let r=new i,a=URL.createObjectURL(new Blob([t],{type:"text/javascript"}));return Object.assign(r,{address:a,settings:e,parts:n,texts:s}),r.opened=r.start(),await r.opened,r}async start(){let{settings:t,texts:e}=this,n=null,s=null;try{n=this.worker=this.begin(),n.onmessage=({data:c})=>this.heard(c);let r=new Promise((c,h)=>{n.onerror=u=>h(new Error(u.message||"no worker"))});this.send("prepare",{settings:t,texts:e}).catch(()=>null),s=await Promise.race([this.parts,r]);let a=Promise.race([this.send("open",{settings:t,parts:s}),r]),l=!t.shifted.length&&navigator.hardwareConcurrency>1&&(navigator.deviceMemory??8)>=4?this.getHelp(s).catch(()=>null):null;await a,l&&l.then(c=>c&&this.worker===n&&this.send("helper",{port:c},[c])).catch(()=>null)}catch{if(n&&this.worker!==n)return;n?.terminate(),this.worker=null,this.answer=ju(),await this.send("open",{settings:t,parts:s??await this.parts})}}begin(){let t=new Worker(this.address);return this.workers.push(t),t}stop(){if(this.worker){for(let t of this.workers.splice(0))t.onmessage=null,t.terminate();for(let{reject:t}of this.waiting.values())t(new Error("stopped"));this.waiting.clear(),this.opened=this.start()}}async getHelp({wasm:t,graph:e,adapted:n,weights:s}){let r=this.begin(),{port1:a,port2:o}=new MessageChannel;return await new Promise((l,c)=>{r.onmessage=({data:h})=>h.error?c(new Error(h.error)):l(),r.onerror=c,r.postMessage({id:0,call:"help",parts:{wasm:t,graph:e,adapted:n,weights:s},names:this.settings.weights,port:o},[o])}),a}async call(t,e,n=null){return await this.opened,this.send(t,e,[],n)}send(t,e,n=[],s=null){return this.worker?new Promise((r,a)=>{this.waiting.set(++this.count,{resolve:r,reject:a,told:s}),this.worker.postMessage({id:this.count,call:t,...e},n)}):this.answer(t,e,s??(()=>{}))}heard({id:t,result:e,error:n,progress:s}){let{resolve:r,reject:a,told:o}=this.waiting.get(t);if(s!==void 0){o?.(s);return}this.waiting.delete(t),n===void 0?r(e):a(new Error(n))}};async function wg(i){i.readyState==="loading"&&await new Promise(n=>i.addEventListener("DOMContentLoaded",n));let t=[...i.querySelectorAll('script[id^="part-"]')],e=await Promise.all(t.map(async n=>{let s=FM(n.textContent);return n.remove(),[n.id.slice(5),await BM(s)]}));return Object.fromEntries(e)}function FM(i){if(Uint8Array.fromBase64)return Uint8Array.fromBase64(i);let t=atob(i),e=new Uint8Array(t.length);for(let n=0;n<t.length;n++)e[n]=t.charCodeAt(n);return e}async function BM(i){let t=new Blob([i]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(t).arrayBuffer())}var kM={en:["a person walks forward","a person waves with the right hand","a person jumps"],es:["una persona corre","una persona salta"],fr:["une personne salue de la main","une personne marche"],de:["eine Person verbeugt sich","eine Person geht drei Meter und winkt dann"],ja:["人が歩く","人が右手を振る"],zh:["一个人向前走","一个人跳"]},Sg=i=>i.flatMap(t=>(kM[t]??[]).map(e=>({language:t,prompt:e}))),bg=(i,t,e,n)=>Array.from({length:n},(s,r)=>{let a=t+(e-t)*r/(n-1);return[i-i*Math.cos(a),i*Math.sin(a)].map(o=>Math.round(o*100)/100+0)}),Ra={none:{label:"its own way",points:null},draw:{label:"draw one …"},straight:{label:"straight, 4 m",points:[[0,0],[0,4]]},left:{label:"a bend to the left",points:bg(2,0,Math.PI/2,12)},circle:{label:"a circle, 3 m across",points:bg(1.5,0,2*Math.PI,25)},zigzag:{label:"a zigzag",points:[[0,0],[.8,1.2],[-.8,2.4],[0,3.6]]},drawn:{label:"as drawn"},clip:{label:"none with a clip"}};var Qe={blocks:24,text:300,seconds:[.5,30],takes:4,seed:2147483647,points:400,room:50},zM=1,Eg={blocks:[{text:"a person waves",seconds:4}],seed:0,takes:2,chosen:0,path:null,clip:null},Os=(i,[t,e],n)=>{let s=Number(i);return Number.isFinite(s)?Math.min(Math.max(s,t),e):n},af=(i,t,e)=>Math.round(Os(i,t,e)),Ca=i=>i.reduce((t,{seconds:e})=>t+e,0);function Ag(i){if(typeof i!="object"||i===null||!Array.isArray(i.blocks)||!i.blocks.length)return null;let t=i.blocks.slice(0,Qe.blocks).map(s=>({text:String(s?.text??"").slice(0,Qe.text),seconds:Math.round(Os(s?.seconds,Qe.seconds,4)*10)/10})),e=af(i.takes,[1,Qe.takes],1),n=null;if(Array.isArray(i.path)&&i.path.length>1){let s=[-Qe.room,Qe.room];n=i.path.slice(0,Qe.points).map(r=>[0,1].map(a=>Math.round(Os(r?.[a],s,0)*100)/100)),n.every(r=>Math.hypot(r[0]-n[0][0],r[1]-n[0][1])<.05)&&(n=null)}return{blocks:t,seed:af(i.seed,[0,Qe.seed],0),takes:e,chosen:af(i.chosen,[0,e-1],0),path:n,clip:i.clip??null}}function Tg(i){let t=new TextEncoder().encode(JSON.stringify({v:zM,...i,clip:void 0})),e="";for(let n of t)e+=String.fromCharCode(n);return btoa(e).replaceAll("+","-").replaceAll("/","_").replaceAll("=","")}function of(i){try{let t=atob(i.replace(/^#/,"").replaceAll("-","+").replaceAll("_","/"));return Ag({...JSON.parse(new TextDecoder().decode(Uint8Array.from(t,e=>e.charCodeAt(0)))),clip:null})}catch{return null}}var Ml=class{constructor(t,e){Object.assign(this,{now:t,past:[],future:[],changed:e})}change(t,e=null){let n=Ag({...this.now,...t});if(n){if(JSON.stringify(n)===JSON.stringify(this.now)){this.changed();return}(e===null||e!==this.kind)&&this.past.push(this.now),this.past=this.past.slice(-200),this.future=[],this.kind=e,this.now=n,this.changed()}}rest(){this.kind=null}undo(){this.move(this.past,this.future)}redo(){this.move(this.future,this.past)}move(t,e){t.length&&(e.push(this.now),this.now=t.pop(),this.kind=null,this.changed())}};var ms={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},gs={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},c0=0,zf=1,h0=2;var Hs=1,u0=2,Xr=3,_s=0,Nn=1,Ti=2,Ws=0,$r=1,Gf=2,Vf=3,Hf=4,f0=5;var Xs=100,d0=101,p0=102,m0=103,g0=104,_0=200,y0=201,x0=202,v0=203,Wf=204,Xf=205,M0=206,w0=207,b0=208,S0=209,E0=210,A0=211,T0=212,R0=213,C0=214,ql=0,Yl=1,Zl=2,Lr=3,Jl=4,Kl=5,jl=6,Ql=7,Sc=0,P0=1,I0=2,Ri=0,$f=1,qf=2,Yf=3,Zf=4,Jf=5,Kf=6,jf=7,If="attached",L0="detached",Qf=300,$s=301,qr=302,Ec=303,Ac=304,tc=1e3,Si=1001,ec=1002,hn=1003,N0=1004;var fo=1005;var In=1006,Tc=1007;var Yi=1008;var kn=1009,td=1010,ed=1011,Yr=1012,Rc=1013,gi=1014,si=1015,_i=1016,Cc=1017,Pc=1018,qs=1020,nd=35902,id=35899,sd=1021,rd=1022,ri=1023,Vi=1026,Zi=1027,ad=1028,Ic=1029,ys=1030,Lc=1031;var Nc=1033,po=33776,mo=33777,go=33778,_o=33779,Dc=35840,Oc=35841,Uc=35842,Fc=35843,Bc=36196,kc=37492,zc=37496,Gc=37488,Vc=37489,yo=37490,Hc=37491,Wc=37808,Xc=37809,$c=37810,qc=37811,Yc=37812,Zc=37813,Jc=37814,Kc=37815,jc=37816,Qc=37817,th=37818,eh=37819,nh=37820,ih=37821,sh=36492,rh=36494,ah=36495,oh=36283,lh=36284,xo=36285,ch=36286;var ka=2300,nc=2301,Xl=2302,Lf=2303,Nf=2400,Df=2401,Of=2402;var D0=3200;var hh=0,O0=1,Ji="",vn="srgb",za="srgb-linear",Ga="linear",we="srgb";var $l=7680;var U0=519,F0=512,B0=513,k0=514,od=515,z0=516,G0=517,ld=518,cd=519,V0=35044;var hd="300 es",ii=2e3,Nr=2001;function GM(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function VM(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Va(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function H0(){let i=Va("canvas");return i.style.display="block",i}var Rg={},Dr=null;function ud(...i){let t="THREE."+i.shift();Dr?Dr("log",t,...i):console.log(t,...i)}function W0(i){let t=i[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=i[1];e&&e.isStackTrace?i[0]+=" "+e.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Ut(...i){i=W0(i);let t="THREE."+i.shift();if(Dr)Dr("warn",t,...i);else{let e=i[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...i)}}function Wt(...i){i=W0(i);let t="THREE."+i.shift();if(Dr)Dr("error",t,...i);else{let e=i[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...i)}}function Ua(...i){let t=i.join(" ");t in Rg||(Rg[t]=!0,Ut(...i))}function X0(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var $0={[ql]:ql,[Zl]:jl,[Jl]:Jl,[Lr]:Kl,[Yl]:Yl,[jl]:Zl,[Ql]:Ql,[Kl]:Lr},mi=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){let n=this._listeners;return n===void 0?!1:n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){let n=this._listeners;if(n===void 0)return;let s=n[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let n=e[t.type];if(n!==void 0){t.target=this;let s=n.slice(0);for(let r=0,a=s.length;r<a;r++)s[r].call(this,t);t.target=null}}},yn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Cg=1234567,Fa=Math.PI/180,Or=180/Math.PI;function Ys(){let i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(yn[i&255]+yn[i>>8&255]+yn[i>>16&255]+yn[i>>24&255]+"-"+yn[t&255]+yn[t>>8&255]+"-"+yn[t>>16&15|64]+yn[t>>24&255]+"-"+yn[e&63|128]+yn[e>>8&255]+"-"+yn[e>>16&255]+yn[e>>24&255]+yn[n&255]+yn[n>>8&255]+yn[n>>16&255]+yn[n>>24&255]).toLowerCase()}function se(i,t,e){return Math.max(t,Math.min(e,i))}function fd(i,t){return(i%t+t)%t}function HM(i,t,e,n,s){return n+(i-t)*(s-n)/(e-t)}function WM(i,t,e){return i!==t?(e-i)/(t-i):0}function Ba(i,t,e){return(1-e)*i+e*t}function XM(i,t,e,n){return Ba(i,t,1-Math.exp(-e*n))}function $M(i,t=1){return t-Math.abs(fd(i,t*2)-t)}function qM(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*(3-2*i))}function YM(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*i*(i*(i*6-15)+10))}function ZM(i,t){return i+Math.floor(Math.random()*(t-i+1))}function JM(i,t){return i+Math.random()*(t-i)}function KM(i){return i*(.5-Math.random())}function jM(i){i!==void 0&&(Cg=i);let t=Cg+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function QM(i){return i*Fa}function tw(i){return i*Or}function ew(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function nw(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function dd(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function iw(i,t,e,n,s){let r=Math.cos,a=Math.sin,o=r(e/2),l=a(e/2),c=r((t+n)/2),h=a((t+n)/2),u=r((t-n)/2),f=a((t-n)/2),d=r((n-t)/2),p=a((n-t)/2);switch(s){case"XYX":i.set(o*h,l*u,l*f,o*c);break;case"YZY":i.set(l*f,o*h,l*u,o*c);break;case"ZXZ":i.set(l*u,l*f,o*h,o*c);break;case"XZX":i.set(o*h,l*p,l*d,o*c);break;case"YXY":i.set(l*d,o*h,l*p,o*c);break;case"ZYZ":i.set(l*p,l*d,o*h,o*c);break;default:Ut("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function pd(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function q0(i,t){if(t.constructor===Float32Array)return i;let e=pd(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/e,-1)}function Y0(i,t){if(t.constructor===Float32Array)return i;let e=pd(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*e)}var md={DEG2RAD:Fa,RAD2DEG:Or,generateUUID:Ys,clamp:se,euclideanModulo:fd,mapLinear:HM,inverseLerp:WM,lerp:Ba,damp:XM,pingpong:$M,smoothstep:qM,smootherstep:YM,randInt:ZM,randFloat:JM,randFloatSpread:KM,seededRandom:jM,degToRad:QM,radToDeg:tw,isPowerOfTwo:ew,ceilPowerOfTwo:nw,floorPowerOfTwo:dd,setQuaternionFromProperEuler:iw,normalize:Y0,denormalize:q0},zt=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=se(this.x,t.x,e.x),this.y=se(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=se(this.x,t,e),this.y=se(this.y,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(se(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(se(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,a=this.y-t.y;return this.x=r*n-a*s+t.x,this.y=r*s+a*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Mn=class{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,a,o){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],f=r[a+0],d=r[a+1],p=r[a+2],_=r[a+3];if(u!==_||l!==f||c!==d||h!==p){let m=l*f+c*d+h*p+u*_;m<0&&(f=-f,d=-d,p=-p,_=-_,m=-m);let g=1-o;if(m<.9995){let x=Math.acos(m),w=Math.sin(x);g=Math.sin(g*x)/w,o=Math.sin(o*x)/w,l=l*g+f*o,c=c*g+d*o,h=h*g+p*o,u=u*g+_*o}else{l=l*g+f*o,c=c*g+d*o,h=h*g+p*o,u=u*g+_*o;let x=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=x,c*=x,h*=x,u*=x}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,s,r,a){let o=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[a],f=r[a+1],d=r[a+2],p=r[a+3];return t[e]=o*p+h*u+l*d-c*f,t[e+1]=l*p+h*f+c*u-o*d,t[e+2]=c*p+h*d+o*f-l*u,t[e+3]=h*p-o*u-l*f-c*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,s=t._y,r=t._z,a=t._order,o=Math.cos,l=Math.sin,c=o(n/2),h=o(s/2),u=o(r/2),f=l(n/2),d=l(s/2),p=l(r/2);switch(a){case"XYZ":this._x=f*h*u+c*d*p,this._y=c*d*u-f*h*p,this._z=c*h*p+f*d*u,this._w=c*h*u-f*d*p;break;case"YXZ":this._x=f*h*u+c*d*p,this._y=c*d*u-f*h*p,this._z=c*h*p-f*d*u,this._w=c*h*u+f*d*p;break;case"ZXY":this._x=f*h*u-c*d*p,this._y=c*d*u+f*h*p,this._z=c*h*p+f*d*u,this._w=c*h*u-f*d*p;break;case"ZYX":this._x=f*h*u-c*d*p,this._y=c*d*u+f*h*p,this._z=c*h*p-f*d*u,this._w=c*h*u+f*d*p;break;case"YZX":this._x=f*h*u+c*d*p,this._y=c*d*u+f*h*p,this._z=c*h*p-f*d*u,this._w=c*h*u-f*d*p;break;case"XZY":this._x=f*h*u-c*d*p,this._y=c*d*u-f*h*p,this._z=c*h*p+f*d*u,this._w=c*h*u+f*d*p;break;default:Ut("Quaternion: .setFromEuler() encountered an unknown order: "+a)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],s=e[4],r=e[8],a=e[1],o=e[5],l=e[9],c=e[2],h=e[6],u=e[10],f=n+o+u;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(h-l)*d,this._y=(r-c)*d,this._z=(a-s)*d}else if(n>o&&n>u){let d=2*Math.sqrt(1+n-o-u);this._w=(h-l)/d,this._x=.25*d,this._y=(s+a)/d,this._z=(r+c)/d}else if(o>u){let d=2*Math.sqrt(1+o-n-u);this._w=(r-c)/d,this._x=(s+a)/d,this._y=.25*d,this._z=(l+h)/d}else{let d=2*Math.sqrt(1+u-n-o);this._w=(a-s)/d,this._x=(r+c)/d,this._y=(l+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<1e-8?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(se(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,s=t._y,r=t._z,a=t._w,o=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+a*o+s*c-r*l,this._y=s*h+a*l+r*o-n*c,this._z=r*h+a*c+n*l-s*o,this._w=a*h-n*o-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let n=t._x,s=t._y,r=t._z,a=t._w,o=this.dot(t);o<0&&(n=-n,s=-s,r=-r,a=-a,o=-o);let l=1-e;if(o<.9995){let c=Math.acos(o),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+a*e,this._onChangeCallback()}else this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+a*e,this.normalize();return this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},k=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,n=0){this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Pg.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Pg.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=t.elements,a=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*a,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*a,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*a,this}applyQuaternion(t){let e=this.x,n=this.y,s=this.z,r=t.x,a=t.y,o=t.z,l=t.w,c=2*(a*s-o*n),h=2*(o*e-r*s),u=2*(r*n-a*e);return this.x=e+l*c+a*u-o*h,this.y=n+l*h+o*c-r*u,this.z=s+l*u+r*h-a*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=se(this.x,t.x,e.x),this.y=se(this.y,t.y,e.y),this.z=se(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=se(this.x,t,e),this.y=se(this.y,t,e),this.z=se(this.z,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(se(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,s=t.y,r=t.z,a=e.x,o=e.y,l=e.z;return this.x=s*l-r*o,this.y=r*a-n*l,this.z=n*o-s*a,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return lf.copy(this).projectOnVector(t),this.sub(lf)}reflect(t){return this.sub(lf.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(se(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},lf=new k,Pg=new Mn,Yt=class{static{this.prototype.isMatrix3=!0}constructor(t,e,n,s,r,a,o,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,a,o,l,c)}set(t,e,n,s,r,a,o,l,c){let h=this.elements;return h[0]=t,h[1]=s,h[2]=o,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=a,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,a=n[0],o=n[3],l=n[6],c=n[1],h=n[4],u=n[7],f=n[2],d=n[5],p=n[8],_=s[0],m=s[3],g=s[6],x=s[1],w=s[4],M=s[7],E=s[2],T=s[5],y=s[8];return r[0]=a*_+o*x+l*E,r[3]=a*m+o*w+l*T,r[6]=a*g+o*M+l*y,r[1]=c*_+h*x+u*E,r[4]=c*m+h*w+u*T,r[7]=c*g+h*M+u*y,r[2]=f*_+d*x+p*E,r[5]=f*m+d*w+p*T,r[8]=f*g+d*M+p*y,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8];return e*a*h-e*o*c-n*r*h+n*o*l+s*r*c-s*a*l}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8],u=h*a-o*c,f=o*l-h*r,d=c*r-a*l,p=e*u+n*f+s*d;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/p;return t[0]=u*_,t[1]=(s*c-h*n)*_,t[2]=(o*n-s*a)*_,t[3]=f*_,t[4]=(h*e-s*l)*_,t[5]=(s*r-o*e)*_,t[6]=d*_,t[7]=(n*l-c*e)*_,t[8]=(a*e-n*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,a,o){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*a+c*o)+a+t,-s*c,s*l,-s*(-c*a+l*o)+o+e,0,0,1),this}scale(t,e){return Ua("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(cf.makeScale(t,e)),this}rotate(t){return Ua("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(cf.makeRotation(-t)),this}translate(t,e){return Ua("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(cf.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}},cf=new Yt,Ig=new Yt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Lg=new Yt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function sw(){let i={enabled:!0,workingColorSpace:za,spaces:{},convert:function(s,r,a){return this.enabled===!1||r===a||!r||!a||(this.spaces[r].transfer===we&&(s.r=Gi(s.r),s.g=Gi(s.g),s.b=Gi(s.b)),this.spaces[r].primaries!==this.spaces[a].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[a].fromXYZ)),this.spaces[a].transfer===we&&(s.r=Ir(s.r),s.g=Ir(s.g),s.b=Ir(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ji?Ga:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,a){return s.copy(this.spaces[a].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[za]:{primaries:t,whitePoint:n,transfer:Ga,toXYZ:Ig,fromXYZ:Lg,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:vn},outputColorSpaceConfig:{drawingBufferColorSpace:vn}},[vn]:{primaries:t,whitePoint:n,transfer:we,toXYZ:Ig,fromXYZ:Lg,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:vn}}}),i}var he=sw();function Gi(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Ir(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var yr,ic=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let n;if(t instanceof HTMLCanvasElement)n=t;else{yr===void 0&&(yr=Va("canvas")),yr.width=t.width,yr.height=t.height;let s=yr.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),n=yr}return n.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=Va("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let a=0;a<r.length;a++)r[a]=Gi(r[a]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(Gi(e[n]/255)*255):e[n]=Gi(e[n]);return{data:e,width:t.width,height:t.height}}else return Ut("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},rw=0,Ur=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:rw++}),this.uuid=Ys(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let a=0,o=s.length;a<o;a++)s[a].isDataTexture?r.push(hf(s[a].image)):r.push(hf(s[a]))}else r=hf(s);n.url=r}return e||(t.images[this.uuid]=n),n}};function hf(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?ic.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Ut("Texture: Unable to serialize Texture."),{})}var aw=0,uf=new k,Fn=class i extends mi{constructor(t=i.DEFAULT_IMAGE,e=i.DEFAULT_MAPPING,n=Si,s=Si,r=In,a=Yi,o=ri,l=kn,c=i.DEFAULT_ANISOTROPY,h=Ji){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:aw++}),this.uuid=Ys(),this.name="",this.source=new Ur(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=a,this.anisotropy=c,this.format=o,this.internalFormat=null,this.type=l,this.offset=new zt(0,0),this.repeat=new zt(1,1),this.center=new zt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Yt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(uf).x}get height(){return this.source.getSize(uf).y}get depth(){return this.source.getSize(uf).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let n=t[e];if(n===void 0){Ut(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Ut(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Qf)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case tc:t.x=t.x-Math.floor(t.x);break;case Si:t.x=t.x<0?0:1;break;case ec:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case tc:t.y=t.y-Math.floor(t.y);break;case Si:t.y=t.y<0?0:1;break;case ec:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Fn.DEFAULT_IMAGE=null;Fn.DEFAULT_MAPPING=Qf;Fn.DEFAULT_ANISOTROPY=1;var Se=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,n=0,s=1){this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=this.w,a=t.elements;return this.x=a[0]*e+a[4]*n+a[8]*s+a[12]*r,this.y=a[1]*e+a[5]*n+a[9]*s+a[13]*r,this.z=a[2]*e+a[6]*n+a[10]*s+a[14]*r,this.w=a[3]*e+a[7]*n+a[11]*s+a[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r,l=t.elements,c=l[0],h=l[4],u=l[8],f=l[1],d=l[5],p=l[9],_=l[2],m=l[6],g=l[10];if(Math.abs(h-f)<.01&&Math.abs(u-_)<.01&&Math.abs(p-m)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+_)<.1&&Math.abs(p+m)<.1&&Math.abs(c+d+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let w=(c+1)/2,M=(d+1)/2,E=(g+1)/2,T=(h+f)/4,y=(u+_)/4,A=(p+m)/4;return w>M&&w>E?w<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(w),s=T/n,r=y/n):M>E?M<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(M),n=T/s,r=A/s):E<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(E),n=y/r,s=A/r),this.set(n,s,r,e),this}let x=Math.sqrt((m-p)*(m-p)+(u-_)*(u-_)+(f-h)*(f-h));return Math.abs(x)<.001&&(x=1),this.x=(m-p)/x,this.y=(u-_)/x,this.z=(f-h)/x,this.w=Math.acos((c+d+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=se(this.x,t.x,e.x),this.y=se(this.y,t.y,e.y),this.z=se(this.z,t.z,e.z),this.w=se(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=se(this.x,t,e),this.y=se(this.y,t,e),this.z=se(this.z,t,e),this.w=se(this.w,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(se(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},sc=class extends mi{constructor(t=1,e=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:In,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=n.depth,this.scissor=new Se(0,0,t,e),this.scissorTest=!1,this.viewport=new Se(0,0,t,e),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Fn({width:t,height:e,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:In,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,n=t.textures.length;e<n;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new Ur(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Yn=class extends sc{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},Ha=class extends Fn{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=hn,this.minFilter=hn,this.wrapR=Si,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var rc=class extends Fn{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=hn,this.minFilter=hn,this.wrapR=Si,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var re=class i{static{this.prototype.isMatrix4=!0}constructor(t,e,n,s,r,a,o,l,c,h,u,f,d,p,_,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,a,o,l,c,h,u,f,d,p,_,m)}set(t,e,n,s,r,a,o,l,c,h,u,f,d,p,_,m){let g=this.elements;return g[0]=t,g[4]=e,g[8]=n,g[12]=s,g[1]=r,g[5]=a,g[9]=o,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=f,g[3]=d,g[7]=p,g[11]=_,g[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),n.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,n=t.elements,s=1/xr.setFromMatrixColumn(t,0).length(),r=1/xr.setFromMatrixColumn(t,1).length(),a=1/xr.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*a,e[9]=n[9]*a,e[10]=n[10]*a,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,s=t.y,r=t.z,a=Math.cos(n),o=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let f=a*h,d=a*u,p=o*h,_=o*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=d+p*c,e[5]=f-_*c,e[9]=-o*l,e[2]=_-f*c,e[6]=p+d*c,e[10]=a*l}else if(t.order==="YXZ"){let f=l*h,d=l*u,p=c*h,_=c*u;e[0]=f+_*o,e[4]=p*o-d,e[8]=a*c,e[1]=a*u,e[5]=a*h,e[9]=-o,e[2]=d*o-p,e[6]=_+f*o,e[10]=a*l}else if(t.order==="ZXY"){let f=l*h,d=l*u,p=c*h,_=c*u;e[0]=f-_*o,e[4]=-a*u,e[8]=p+d*o,e[1]=d+p*o,e[5]=a*h,e[9]=_-f*o,e[2]=-a*c,e[6]=o,e[10]=a*l}else if(t.order==="ZYX"){let f=a*h,d=a*u,p=o*h,_=o*u;e[0]=l*h,e[4]=p*c-d,e[8]=f*c+_,e[1]=l*u,e[5]=_*c+f,e[9]=d*c-p,e[2]=-c,e[6]=o*l,e[10]=a*l}else if(t.order==="YZX"){let f=a*l,d=a*c,p=o*l,_=o*c;e[0]=l*h,e[4]=_-f*u,e[8]=p*u+d,e[1]=u,e[5]=a*h,e[9]=-o*h,e[2]=-c*h,e[6]=d*u+p,e[10]=f-_*u}else if(t.order==="XZY"){let f=a*l,d=a*c,p=o*l,_=o*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=f*u+_,e[5]=a*h,e[9]=d*u-p,e[2]=p*u-d,e[6]=o*h,e[10]=_*u+f}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(ow,t,lw)}lookAt(t,e,n){let s=this.elements;return $n.subVectors(t,e),$n.lengthSq()===0&&($n.z=1),$n.normalize(),ss.crossVectors(n,$n),ss.lengthSq()===0&&(Math.abs(n.z)===1?$n.x+=1e-4:$n.z+=1e-4,$n.normalize(),ss.crossVectors(n,$n)),ss.normalize(),wl.crossVectors($n,ss),s[0]=ss.x,s[4]=wl.x,s[8]=$n.x,s[1]=ss.y,s[5]=wl.y,s[9]=$n.y,s[2]=ss.z,s[6]=wl.z,s[10]=$n.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,a=n[0],o=n[4],l=n[8],c=n[12],h=n[1],u=n[5],f=n[9],d=n[13],p=n[2],_=n[6],m=n[10],g=n[14],x=n[3],w=n[7],M=n[11],E=n[15],T=s[0],y=s[4],A=s[8],F=s[12],N=s[1],D=s[5],B=s[9],Z=s[13],P=s[2],$=s[6],Q=s[10],W=s[14],at=s[3],X=s[7],z=s[11],it=s[15];return r[0]=a*T+o*N+l*P+c*at,r[4]=a*y+o*D+l*$+c*X,r[8]=a*A+o*B+l*Q+c*z,r[12]=a*F+o*Z+l*W+c*it,r[1]=h*T+u*N+f*P+d*at,r[5]=h*y+u*D+f*$+d*X,r[9]=h*A+u*B+f*Q+d*z,r[13]=h*F+u*Z+f*W+d*it,r[2]=p*T+_*N+m*P+g*at,r[6]=p*y+_*D+m*$+g*X,r[10]=p*A+_*B+m*Q+g*z,r[14]=p*F+_*Z+m*W+g*it,r[3]=x*T+w*N+M*P+E*at,r[7]=x*y+w*D+M*$+E*X,r[11]=x*A+w*B+M*Q+E*z,r[15]=x*F+w*Z+M*W+E*it,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],a=t[1],o=t[5],l=t[9],c=t[13],h=t[2],u=t[6],f=t[10],d=t[14],p=t[3],_=t[7],m=t[11],g=t[15],x=l*d-c*f,w=o*d-c*u,M=o*f-l*u,E=a*d-c*h,T=a*f-l*h,y=a*u-o*h;return e*(_*x-m*w+g*M)-n*(p*x-m*E+g*T)+s*(p*w-_*E+g*y)-r*(p*M-_*T+m*y)}determinantAffine(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[1],a=t[5],o=t[9],l=t[2],c=t[6],h=t[10];return e*(a*h-o*c)-n*(r*h-o*l)+s*(r*c-a*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8],u=t[9],f=t[10],d=t[11],p=t[12],_=t[13],m=t[14],g=t[15],x=e*o-n*a,w=e*l-s*a,M=e*c-r*a,E=n*l-s*o,T=n*c-r*o,y=s*c-r*l,A=h*_-u*p,F=h*m-f*p,N=h*g-d*p,D=u*m-f*_,B=u*g-d*_,Z=f*g-d*m,P=x*Z-w*B+M*D+E*N-T*F+y*A;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let $=1/P;return t[0]=(o*Z-l*B+c*D)*$,t[1]=(s*B-n*Z-r*D)*$,t[2]=(_*y-m*T+g*E)*$,t[3]=(f*T-u*y-d*E)*$,t[4]=(l*N-a*Z-c*F)*$,t[5]=(e*Z-s*N+r*F)*$,t[6]=(m*M-p*y-g*w)*$,t[7]=(h*y-f*M+d*w)*$,t[8]=(a*B-o*N+c*A)*$,t[9]=(n*N-e*B-r*A)*$,t[10]=(p*T-_*M+g*x)*$,t[11]=(u*M-h*T-d*x)*$,t[12]=(o*F-a*D-l*A)*$,t[13]=(e*D-n*F+s*A)*$,t[14]=(_*w-p*E-m*x)*$,t[15]=(h*E-u*w+f*x)*$,this}scale(t){let e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),s=Math.sin(e),r=1-n,a=t.x,o=t.y,l=t.z,c=r*a,h=r*o;return this.set(c*a+n,c*o-s*l,c*l+s*o,0,c*o+s*l,h*o+n,h*l-s*a,0,c*l-s*o,h*l+s*a,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,a){return this.set(1,n,r,0,t,1,a,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){let s=this.elements,r=e._x,a=e._y,o=e._z,l=e._w,c=r+r,h=a+a,u=o+o,f=r*c,d=r*h,p=r*u,_=a*h,m=a*u,g=o*u,x=l*c,w=l*h,M=l*u,E=n.x,T=n.y,y=n.z;return s[0]=(1-(_+g))*E,s[1]=(d+M)*E,s[2]=(p-w)*E,s[3]=0,s[4]=(d-M)*T,s[5]=(1-(f+g))*T,s[6]=(m+x)*T,s[7]=0,s[8]=(p+w)*y,s[9]=(m-x)*y,s[10]=(1-(f+_))*y,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),e.identity(),this;let a=xr.set(s[0],s[1],s[2]).length(),o=xr.set(s[4],s[5],s[6]).length(),l=xr.set(s[8],s[9],s[10]).length();r<0&&(a=-a),fi.copy(this);let c=1/a,h=1/o,u=1/l;return fi.elements[0]*=c,fi.elements[1]*=c,fi.elements[2]*=c,fi.elements[4]*=h,fi.elements[5]*=h,fi.elements[6]*=h,fi.elements[8]*=u,fi.elements[9]*=u,fi.elements[10]*=u,e.setFromRotationMatrix(fi),n.x=a,n.y=o,n.z=l,this}makePerspective(t,e,n,s,r,a,o=ii,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(n-s),f=(e+t)/(e-t),d=(n+s)/(n-s),p,_;if(l)p=r/(a-r),_=a*r/(a-r);else if(o===ii)p=-(a+r)/(a-r),_=-2*a*r/(a-r);else if(o===Nr)p=-a/(a-r),_=-a*r/(a-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+o);return c[0]=h,c[4]=0,c[8]=f,c[12]=0,c[1]=0,c[5]=u,c[9]=d,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=_,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,n,s,r,a,o=ii,l=!1){let c=this.elements,h=2/(e-t),u=2/(n-s),f=-(e+t)/(e-t),d=-(n+s)/(n-s),p,_;if(l)p=1/(a-r),_=a/(a-r);else if(o===ii)p=-2/(a-r),_=-(a+r)/(a-r);else if(o===Nr)p=-1/(a-r),_=-r/(a-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+o);return c[0]=h,c[4]=0,c[8]=0,c[12]=f,c[1]=0,c[5]=u,c[9]=0,c[13]=d,c[2]=0,c[6]=0,c[10]=p,c[14]=_,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}},xr=new k,fi=new re,ow=new k(0,0,0),lw=new k(1,1,1),ss=new k,wl=new k,$n=new k,Ng=new re,Dg=new Mn,Hi=class i{constructor(t=0,e=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let s=t.elements,r=s[0],a=s[4],o=s[8],l=s[1],c=s[5],h=s[9],u=s[2],f=s[6],d=s[10];switch(e){case"XYZ":this._y=Math.asin(se(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-a,r)):(this._x=Math.atan2(f,c),this._z=0);break;case"YXZ":this._x=Math.asin(-se(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(o,d),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(se(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-a,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-se(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-a,c));break;case"YZX":this._z=Math.asin(se(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(o,d));break;case"XZY":this._z=Math.asin(-se(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(f,c),this._y=Math.atan2(o,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:Ut("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return Ng.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Ng,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Dg.setFromEuler(this),this.setFromQuaternion(Dg,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Hi.DEFAULT_ORDER="XYZ";var Fr=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},cw=0,Og=new k,vr=new Mn,Ui=new re,bl=new k,Pa=new k,hw=new k,uw=new Mn,Ug=new k(1,0,0),Fg=new k(0,1,0),Bg=new k(0,0,1),kg={type:"added"},fw={type:"removed"},Mr={type:"childadded",child:null},ff={type:"childremoved",child:null},un=class i extends mi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:cw++}),this.uuid=Ys(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let t=new k,e=new Hi,n=new Mn,s=new k(1,1,1);function r(){n.setFromEuler(e,!1)}function a(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(a),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new re},normalMatrix:{value:new Yt}}),this.matrix=new re,this.matrixWorld=new re,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Fr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return vr.setFromAxisAngle(t,e),this.quaternion.multiply(vr),this}rotateOnWorldAxis(t,e){return vr.setFromAxisAngle(t,e),this.quaternion.premultiply(vr),this}rotateX(t){return this.rotateOnAxis(Ug,t)}rotateY(t){return this.rotateOnAxis(Fg,t)}rotateZ(t){return this.rotateOnAxis(Bg,t)}translateOnAxis(t,e){return Og.copy(t).applyQuaternion(this.quaternion),this.position.add(Og.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Ug,t)}translateY(t){return this.translateOnAxis(Fg,t)}translateZ(t){return this.translateOnAxis(Bg,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Ui.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?bl.copy(t):bl.set(t,e,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Pa.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Ui.lookAt(Pa,bl,this.up):Ui.lookAt(bl,Pa,this.up),this.quaternion.setFromRotationMatrix(Ui),s&&(Ui.extractRotation(s.matrixWorld),vr.setFromRotationMatrix(Ui),this.quaternion.premultiply(vr.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Wt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(kg),Mr.child=t,this.dispatchEvent(Mr),Mr.child=null):Wt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(fw),ff.child=t,this.dispatchEvent(ff),ff.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Ui.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Ui.multiply(t.parent.matrixWorld)),t.applyMatrix4(Ui),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(kg),Mr.child=t,this.dispatchEvent(Mr),Mr.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){let a=this.children[n].getObjectByProperty(t,e);if(a!==void 0)return a}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let s=this.children;for(let r=0,a=s.length;r<a;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Pa,t,hw),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Pa,uw,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,n=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*n-r[8]*s,r[13]+=n-r[1]*e-r[5]*n-r[9]*s,r[14]+=s-r[2]*e-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e,n=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),e===!0){let r=this.children;for(let a=0,o=r.length;a<o;a++)r[a].updateWorldMatrix(!1,!0,n)}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(o=>({...o,boundingBox:o.boundingBox?o.boundingBox.toJSON():void 0,boundingSphere:o.boundingSphere?o.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(o=>({...o})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(o,l){return o[l.uuid]===void 0&&(o[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let o=this.geometry.parameters;if(o!==void 0&&o.shapes!==void 0){let l=o.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let o=[];for(let l=0,c=this.material.length;l<c;l++)o.push(r(t.materials,this.material[l]));s.material=o}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let o=0;o<this.children.length;o++)s.children.push(this.children[o].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let o=0;o<this.animations.length;o++){let l=this.animations[o];s.animations.push(r(t.animations,l))}}if(e){let o=a(t.geometries),l=a(t.materials),c=a(t.textures),h=a(t.images),u=a(t.shapes),f=a(t.skeletons),d=a(t.animations),p=a(t.nodes);o.length>0&&(n.geometries=o),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),f.length>0&&(n.skeletons=f),d.length>0&&(n.animations=d),p.length>0&&(n.nodes=p)}return n.object=s,n;function a(o){let l=[];for(let c in o){let h=o[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let s=t.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};un.DEFAULT_UP=new k(0,1,0);un.DEFAULT_MATRIX_AUTO_UPDATE=!0;un.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var zs=class extends un{constructor(){super(),this.isGroup=!0,this.type="Group"}},dw={type:"move"},Br=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new zs,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new zs,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new k,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new k),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new zs,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new k,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new k,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,a=null,o=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){a=!0;for(let _ of t.hand.values()){let m=e.getJointPose(_,n),g=this._getHandJoint(c,_);m!==null&&(g.matrix.fromArray(m.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=m.radius),g.visible=m!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],f=h.position.distanceTo(u.position),d=.02,p=.005;c.inputState.pinching&&f>d+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&f<=d-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));o!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(o.matrix.fromArray(s.transform.matrix),o.matrix.decompose(o.position,o.quaternion,o.scale),o.matrixWorldNeedsUpdate=!0,s.linearVelocity?(o.hasLinearVelocity=!0,o.linearVelocity.copy(s.linearVelocity)):o.hasLinearVelocity=!1,s.angularVelocity?(o.hasAngularVelocity=!0,o.angularVelocity.copy(s.angularVelocity)):o.hasAngularVelocity=!1,this.dispatchEvent(dw)))}return o!==null&&(o.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=a!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new zs;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},Z0={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},rs={h:0,s:0,l:0},Sl={h:0,s:0,l:0};function df(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}var Jt=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=vn){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,he.colorSpaceToWorking(this,e),this}setRGB(t,e,n,s=he.workingColorSpace){return this.r=t,this.g=e,this.b=n,he.colorSpaceToWorking(this,s),this}setHSL(t,e,n,s=he.workingColorSpace){if(t=fd(t,1),e=se(e,0,1),n=se(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,a=2*n-r;this.r=df(a,r,t+1/3),this.g=df(a,r,t),this.b=df(a,r,t-1/3)}return he.colorSpaceToWorking(this,s),this}setStyle(t,e=vn){function n(r){r!==void 0&&parseFloat(r)<1&&Ut("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,a=s[1],o=s[2];switch(a){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Ut("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],a=r.length;if(a===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(a===6)return this.setHex(parseInt(r,16),e);Ut("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=vn){let n=Z0[t.toLowerCase()];return n!==void 0?this.setHex(n,e):Ut("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=Gi(t.r),this.g=Gi(t.g),this.b=Gi(t.b),this}copyLinearToSRGB(t){return this.r=Ir(t.r),this.g=Ir(t.g),this.b=Ir(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=vn){return he.workingToColorSpace(xn.copy(this),t),Math.round(se(xn.r*255,0,255))*65536+Math.round(se(xn.g*255,0,255))*256+Math.round(se(xn.b*255,0,255))}getHexString(t=vn){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=he.workingColorSpace){he.workingToColorSpace(xn.copy(this),e);let n=xn.r,s=xn.g,r=xn.b,a=Math.max(n,s,r),o=Math.min(n,s,r),l,c,h=(o+a)/2;if(o===a)l=0,c=0;else{let u=a-o;switch(c=h<=.5?u/(a+o):u/(2-a-o),a){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=he.workingColorSpace){return he.workingToColorSpace(xn.copy(this),e),t.r=xn.r,t.g=xn.g,t.b=xn.b,t}getStyle(t=vn){he.workingToColorSpace(xn.copy(this),t);let e=xn.r,n=xn.g,s=xn.b;return t!==vn?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(rs),this.setHSL(rs.h+t,rs.s+e,rs.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(rs),t.getHSL(Sl);let n=Ba(rs.h,Sl.h,e),s=Ba(rs.s,Sl.s,e),r=Ba(rs.l,Sl.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},xn=new Jt;Jt.NAMES=Z0;var Wa=class i{constructor(t,e=1,n=1e3){this.isFog=!0,this.name="",this.color=new Jt(t),this.near=e,this.far=n}clone(){return new i(this.color,this.near,this.far)}toJSON(){return{type:"Fog",name:this.name,color:this.color.getHex(),near:this.near,far:this.far}}},Xa=class extends un{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Hi,this.environmentIntensity=1,this.environmentRotation=new Hi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},di=new k,Fi=new k,pf=new k,Bi=new k,wr=new k,br=new k,zg=new k,mf=new k,gf=new k,_f=new k,yf=new Se,xf=new Se,vf=new Se,cs=class i{constructor(t=new k,e=new k,n=new k){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),di.subVectors(t,e),s.cross(di);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){di.subVectors(s,e),Fi.subVectors(n,e),pf.subVectors(t,e);let a=di.dot(di),o=di.dot(Fi),l=di.dot(pf),c=Fi.dot(Fi),h=Fi.dot(pf),u=a*c-o*o;if(u===0)return r.set(0,0,0),null;let f=1/u,d=(c*l-o*h)*f,p=(a*h-o*l)*f;return r.set(1-d-p,p,d)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,Bi)===null?!1:Bi.x>=0&&Bi.y>=0&&Bi.x+Bi.y<=1}static getInterpolation(t,e,n,s,r,a,o,l){return this.getBarycoord(t,e,n,s,Bi)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Bi.x),l.addScaledVector(a,Bi.y),l.addScaledVector(o,Bi.z),l)}static getInterpolatedAttribute(t,e,n,s,r,a){return yf.setScalar(0),xf.setScalar(0),vf.setScalar(0),yf.fromBufferAttribute(t,e),xf.fromBufferAttribute(t,n),vf.fromBufferAttribute(t,s),a.setScalar(0),a.addScaledVector(yf,r.x),a.addScaledVector(xf,r.y),a.addScaledVector(vf,r.z),a}static isFrontFacing(t,e,n,s){return di.subVectors(n,e),Fi.subVectors(t,e),di.cross(Fi).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return di.subVectors(this.c,this.b),Fi.subVectors(this.a,this.b),di.cross(Fi).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return i.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return i.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return i.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return i.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return i.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,s=this.b,r=this.c,a,o;wr.subVectors(s,n),br.subVectors(r,n),mf.subVectors(t,n);let l=wr.dot(mf),c=br.dot(mf);if(l<=0&&c<=0)return e.copy(n);gf.subVectors(t,s);let h=wr.dot(gf),u=br.dot(gf);if(h>=0&&u<=h)return e.copy(s);let f=l*u-h*c;if(f<=0&&l>=0&&h<=0&&l-h>0)return a=l/(l-h),e.copy(n).addScaledVector(wr,a);_f.subVectors(t,r);let d=wr.dot(_f),p=br.dot(_f);if(p>=0&&d<=p)return e.copy(r);let _=d*c-l*p;if(_<=0&&c>=0&&p<=0)return o=c/(c-p),e.copy(n).addScaledVector(br,o);let m=h*p-d*u;if(m<=0&&u-h>=0&&d-p>=0)return zg.subVectors(r,s),o=(u-h)/(u-h+(d-p)),e.copy(s).addScaledVector(zg,o);let g=1/(m+_+f);return a=_*g,o=f*g,e.copy(n).addScaledVector(wr,a).addScaledVector(br,o)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},Wi=class{constructor(t=new k(1/0,1/0,1/0),e=new k(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(pi.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(pi.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=pi.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let a=0,o=r.count;a<o;a++)t.isMesh===!0?t.getVertexPosition(a,pi):pi.fromBufferAttribute(r,a),pi.applyMatrix4(t.matrixWorld),this.expandByPoint(pi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),El.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),El.copy(n.boundingBox)),El.applyMatrix4(t.matrixWorld),this.union(El)}let s=t.children;for(let r=0,a=s.length;r<a;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,pi),pi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(Ia),Al.subVectors(this.max,Ia),Sr.subVectors(t.a,Ia),Er.subVectors(t.b,Ia),Ar.subVectors(t.c,Ia),as.subVectors(Er,Sr),os.subVectors(Ar,Er),Us.subVectors(Sr,Ar);let e=[0,-as.z,as.y,0,-os.z,os.y,0,-Us.z,Us.y,as.z,0,-as.x,os.z,0,-os.x,Us.z,0,-Us.x,-as.y,as.x,0,-os.y,os.x,0,-Us.y,Us.x,0];return!Mf(e,Sr,Er,Ar,Al)||(e=[1,0,0,0,1,0,0,0,1],!Mf(e,Sr,Er,Ar,Al))?!1:(Tl.crossVectors(as,os),e=[Tl.x,Tl.y,Tl.z],Mf(e,Sr,Er,Ar,Al))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,pi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(pi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(ki[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),ki[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),ki[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),ki[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),ki[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),ki[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),ki[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),ki[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(ki),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},ki=[new k,new k,new k,new k,new k,new k,new k,new k],pi=new k,El=new Wi,Sr=new k,Er=new k,Ar=new k,as=new k,os=new k,Us=new k,Ia=new k,Al=new k,Tl=new k,Fs=new k;function Mf(i,t,e,n,s){for(let r=0,a=i.length-3;r<=a;r+=3){Fs.fromArray(i,r);let o=s.x*Math.abs(Fs.x)+s.y*Math.abs(Fs.y)+s.z*Math.abs(Fs.z),l=t.dot(Fs),c=e.dot(Fs),h=n.dot(Fs);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>o)return!1}return!0}var Ze=new k,Rl=new zt,pw=0,cn=class extends mi{constructor(t,e,n=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:pw++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=V0,this.updateRanges=[],this.gpuType=si,this.version=0,this._normalizationScale=t!==void 0?pd(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)Rl.fromBufferAttribute(this,e),Rl.applyMatrix3(t),this.setXY(e,Rl.x,Rl.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.applyMatrix3(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.applyMatrix4(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.applyNormalMatrix(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.transformDirection(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):q0(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Y0(t,this.array)}};var $a=class extends cn{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var qa=class extends cn{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var dn=class extends cn{constructor(t,e,n){super(new Float32Array(t),e,n)}},mw=new Wi,La=new k,wf=new k,Xi=class{constructor(t=new k,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):mw.setFromPoints(t).getCenter(n);let s=0;for(let r=0,a=t.length;r<a;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;La.subVectors(t,this.center);let e=La.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(La,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(wf.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(La.copy(t.center).add(wf)),this.expandByPoint(La.copy(t.center).sub(wf))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},gw=0,ni=new re,bf=new un,Tr=new k,qn=new Wi,Na=new Wi,ln=new k,Ln=class i extends mi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:gw++}),this.uuid=Ys(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(GM(t)?qa:$a)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new Yt().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return ni.makeRotationFromQuaternion(t),this.applyMatrix4(ni),this}rotateX(t){return ni.makeRotationX(t),this.applyMatrix4(ni),this}rotateY(t){return ni.makeRotationY(t),this.applyMatrix4(ni),this}rotateZ(t){return ni.makeRotationZ(t),this.applyMatrix4(ni),this}translate(t,e,n){return ni.makeTranslation(t,e,n),this.applyMatrix4(ni),this}scale(t,e,n){return ni.makeScale(t,e,n),this.applyMatrix4(ni),this}lookAt(t){return bf.lookAt(t),bf.updateMatrix(),this.applyMatrix4(bf.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Tr).negate(),this.translate(Tr.x,Tr.y,Tr.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let n=[];for(let s=0,r=t.length;s<r;s++){let a=t[s];n.push(a.x,a.y,a.z||0)}this.setAttribute("position",new dn(n,3))}else{let n=Math.min(t.length,e.count);for(let s=0;s<n;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&Ut("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Wi);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Wt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new k(-1/0,-1/0,-1/0),new k(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){let r=e[n];qn.setFromBufferAttribute(r),this.morphTargetsRelative?(ln.addVectors(this.boundingBox.min,qn.min),this.boundingBox.expandByPoint(ln),ln.addVectors(this.boundingBox.max,qn.max),this.boundingBox.expandByPoint(ln)):(this.boundingBox.expandByPoint(qn.min),this.boundingBox.expandByPoint(qn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Wt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Xi);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Wt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new k,1/0);return}if(t){let n=this.boundingSphere.center;if(qn.setFromBufferAttribute(t),e)for(let r=0,a=e.length;r<a;r++){let o=e[r];Na.setFromBufferAttribute(o),this.morphTargetsRelative?(ln.addVectors(qn.min,Na.min),qn.expandByPoint(ln),ln.addVectors(qn.max,Na.max),qn.expandByPoint(ln)):(qn.expandByPoint(Na.min),qn.expandByPoint(Na.max))}qn.getCenter(n);let s=0;for(let r=0,a=t.count;r<a;r++)ln.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(ln));if(e)for(let r=0,a=e.length;r<a;r++){let o=e[r],l=this.morphTargetsRelative;for(let c=0,h=o.count;c<h;c++)ln.fromBufferAttribute(o,c),l&&(Tr.fromBufferAttribute(t,c),ln.add(Tr)),s=Math.max(s,n.distanceToSquared(ln))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Wt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Wt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,s=e.normal,r=e.uv,a=this.getAttribute("tangent");(a===void 0||a.count!==n.count)&&(a=new cn(new Float32Array(4*n.count),4),this.setAttribute("tangent",a));let o=[],l=[],c=new Uint8Array(n.count);for(let F=0;F<n.count;F++)o[F]=new k,l[F]=new k;let h=new k,u=new k,f=new k,d=new zt,p=new zt,_=new zt,m=new k,g=new k;function x(F,N,D){c[F]=c[N]=c[D]=1,h.fromBufferAttribute(n,F),u.fromBufferAttribute(n,N),f.fromBufferAttribute(n,D),d.fromBufferAttribute(r,F),p.fromBufferAttribute(r,N),_.fromBufferAttribute(r,D),u.sub(h),f.sub(h),p.sub(d),_.sub(d);let B=1/(p.x*_.y-_.x*p.y);isFinite(B)&&(m.copy(u).multiplyScalar(_.y).addScaledVector(f,-p.y).multiplyScalar(B),g.copy(f).multiplyScalar(p.x).addScaledVector(u,-_.x).multiplyScalar(B),o[F].add(m),o[N].add(m),o[D].add(m),l[F].add(g),l[N].add(g),l[D].add(g))}let w=this.groups;w.length===0&&(w=[{start:0,count:t.count}]);for(let F=0,N=w.length;F<N;++F){let D=w[F],B=D.start,Z=D.count;for(let P=B,$=B+Z;P<$;P+=3)x(t.getX(P+0),t.getX(P+1),t.getX(P+2))}let M=new k,E=new k,T=new k,y=new k;function A(F){T.fromBufferAttribute(s,F),y.copy(T);let N=o[F];M.copy(N),M.sub(T.multiplyScalar(T.dot(N))).normalize(),E.crossVectors(y,N);let B=E.dot(l[F])<0?-1:1;a.setXYZW(F,M.x,M.y,M.z,B)}for(let F=0,N=n.count;F<N;++F)c[F]&&A(F);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==e.count)n=new cn(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let f=0,d=n.count;f<d;f++)n.setXYZ(f,0,0,0);let s=new k,r=new k,a=new k,o=new k,l=new k,c=new k,h=new k,u=new k;if(t)for(let f=0,d=t.count;f<d;f+=3){let p=t.getX(f+0),_=t.getX(f+1),m=t.getX(f+2);s.fromBufferAttribute(e,p),r.fromBufferAttribute(e,_),a.fromBufferAttribute(e,m),h.subVectors(a,r),u.subVectors(s,r),h.cross(u),o.fromBufferAttribute(n,p),l.fromBufferAttribute(n,_),c.fromBufferAttribute(n,m),o.add(h),l.add(h),c.add(h),n.setXYZ(p,o.x,o.y,o.z),n.setXYZ(_,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let f=0,d=e.count;f<d;f+=3)s.fromBufferAttribute(e,f+0),r.fromBufferAttribute(e,f+1),a.fromBufferAttribute(e,f+2),h.subVectors(a,r),u.subVectors(s,r),h.cross(u),n.setXYZ(f+0,h.x,h.y,h.z),n.setXYZ(f+1,h.x,h.y,h.z),n.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)ln.fromBufferAttribute(t,e),ln.normalize(),t.setXYZ(e,ln.x,ln.y,ln.z)}toNonIndexed(){function t(o,l){let c=o.array,h=o.itemSize,u=o.normalized,f=new c.constructor(l.length*h),d=0,p=0;for(let _=0,m=l.length;_<m;_++){o.isInterleavedBufferAttribute?d=l[_]*o.data.stride+o.offset:d=l[_]*h;for(let g=0;g<h;g++)f[p++]=c[d++]}return new cn(f,h,u)}if(this.index===null)return Ut("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new i,n=this.index.array,s=this.attributes;for(let o in s){let l=s[o],c=t(l,n);e.setAttribute(o,c)}let r=this.morphAttributes;for(let o in r){let l=[],c=r[o];for(let h=0,u=c.length;h<u;h++){let f=c[h],d=t(f,n);l.push(d)}e.morphAttributes[o]=l}e.morphTargetsRelative=this.morphTargetsRelative;let a=this.groups;for(let o=0,l=a.length;o<l;o++){let c=a[o];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,f=c.length;u<f;u++){let d=c[u];h.push(d.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let a=this.groups;a.length>0&&(t.data.groups=JSON.parse(JSON.stringify(a)));let o=this.boundingSphere;return o!==null&&(t.data.boundingSphere=o.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone());let s=t.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let f=0,d=u.length;f<d;f++)h.push(u[f].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let a=t.groups;for(let c=0,h=a.length;c<h;c++){let u=a[c];this.addGroup(u.start,u.count,u.materialIndex)}let o=t.boundingBox;o!==null&&(this.boundingBox=o.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Sf=new k,_w=new k,yw=new Yt,Cn=class{constructor(t=new k(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let s=Sf.subVectors(n,e).cross(_w.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,n=!0){let s=t.delta(Sf),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let a=-(t.start.dot(this.normal)+this.constant)/r;return n===!0&&(a<0||a>1)?null:e.copy(t.start).addScaledVector(s,a)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||yw.getNormalMatrix(t),s=this.coplanarPoint(Sf).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},xw=0,Ei=class extends mi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:xw++}),this.uuid=Ys(),this.name="",this.type="Material",this.blending=$r,this.side=_s,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Wf,this.blendDst=Xf,this.blendEquation=Xs,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Jt(0,0,0),this.blendAlpha=0,this.depthFunc=Lr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=U0,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=$l,this.stencilZFail=$l,this.stencilZPass=$l,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){Ut(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Ut(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let a=[];for(let o in r){let l=r[o];delete l.metadata,a.push(l)}return a}if(e){let r=s(t.textures),a=s(t.images);r.length>0&&(n.textures=r),a.length>0&&(n.images=a)}return n}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Jt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(n=>new Cn().fromJSON(n))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let n=t.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new zt().fromArray(n)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new zt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var zi=new k,Ef=new k,Cl=new k,Pl=new k,$i=class{constructor(t=new k,e=new k(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,zi)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=zi.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(zi.copy(this.origin).addScaledVector(this.direction,e),zi.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){Ef.copy(t).add(e).multiplyScalar(.5),Cl.copy(e).sub(t).normalize(),Pl.copy(this.origin).sub(Ef);let r=t.distanceTo(e)*.5,a=-this.direction.dot(Cl),o=Pl.dot(this.direction),l=-Pl.dot(Cl),c=Pl.lengthSq(),h=Math.abs(1-a*a),u,f,d,p;if(h>0)if(u=a*l-o,f=a*o-l,p=r*h,u>=0)if(f>=-p)if(f<=p){let _=1/h;u*=_,f*=_,d=u*(u+a*f+2*o)+f*(a*u+f+2*l)+c}else f=r,u=Math.max(0,-(a*f+o)),d=-u*u+f*(f+2*l)+c;else f=-r,u=Math.max(0,-(a*f+o)),d=-u*u+f*(f+2*l)+c;else f<=-p?(u=Math.max(0,-(-a*r+o)),f=u>0?-r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c):f<=p?(u=0,f=Math.min(Math.max(-r,-l),r),d=f*(f+2*l)+c):(u=Math.max(0,-(a*r+o)),f=u>0?r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c);else f=a>0?-r:r,u=Math.max(0,-(a*f+o)),d=-u*u+f*(f+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Ef).addScaledVector(Cl,f),d}intersectSphere(t,e){if(t.radius<0)return null;zi.subVectors(t.center,this.origin);let n=zi.dot(this.direction),s=zi.dot(zi)-n*n,r=t.radius*t.radius;if(s>r)return null;let a=Math.sqrt(r-s),o=n-a,l=n+a;return l<0?null:o<0?this.at(l,e):this.at(o,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,a,o,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return c>=0?(n=(t.min.x-f.x)*c,s=(t.max.x-f.x)*c):(n=(t.max.x-f.x)*c,s=(t.min.x-f.x)*c),h>=0?(r=(t.min.y-f.y)*h,a=(t.max.y-f.y)*h):(r=(t.max.y-f.y)*h,a=(t.min.y-f.y)*h),n>a||r>s||((r>n||isNaN(n))&&(n=r),(a<s||isNaN(s))&&(s=a),u>=0?(o=(t.min.z-f.z)*u,l=(t.max.z-f.z)*u):(o=(t.max.z-f.z)*u,l=(t.min.z-f.z)*u),n>l||o>s)||((o>n||n!==n)&&(n=o),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,zi)!==null}intersectTriangle(t,e,n,s,r){let a=this.origin,o=this.direction,l=o.x,c=o.y,h=o.z,u=t.x-a.x,f=t.y-a.y,d=t.z-a.z,p=e.x-a.x,_=e.y-a.y,m=e.z-a.z,g=n.x-a.x,x=n.y-a.y,w=n.z-a.z,M=Math.abs(l),E=Math.abs(c),T=Math.abs(h),y,A,F,N,D,B,Z,P,$,Q,W,at;if(M>=E&&M>=T?(F=l,B=u,$=p,at=g,l>=0?(y=c,A=h,N=f,D=d,Z=_,P=m,Q=x,W=w):(y=h,A=c,N=d,D=f,Z=m,P=_,Q=w,W=x)):E>=T?(F=c,B=f,$=_,at=x,c>=0?(y=h,A=l,N=d,D=u,Z=m,P=p,Q=w,W=g):(y=l,A=h,N=u,D=d,Z=p,P=m,Q=g,W=w)):(F=h,B=d,$=m,at=w,h>=0?(y=l,A=c,N=u,D=f,Z=p,P=_,Q=g,W=x):(y=c,A=l,N=f,D=u,Z=_,P=p,Q=x,W=g)),F===0)return null;let X=y/F,z=A/F,it=1/F,Rt=N-X*B,kt=D-z*B,et=Z-X*$,pt=P-z*$,_t=Q-X*at,Nt=W-z*at,lt=_t*pt-Nt*et,Tt=Rt*Nt-kt*_t,oe=et*kt-pt*Rt;if(s){if(lt<0||Tt<0||oe<0)return null}else if((lt<0||Tt<0||oe<0)&&(lt>0||Tt>0||oe>0))return null;let Ft=lt+Tt+oe;if(Ft===0)return null;let ee=it*(lt*B+Tt*$+oe*at);return(Ft>0?ee<0:ee>0)?null:this.at(ee/Ft,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},kr=class extends Ei{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Jt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Hi,this.combine=Sc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Gg=new re,Bs=new $i,Il=new Xi,Vg=new k,Ll=new k,Nl=new k,Dl=new k,Af=new k,Ol=new k,Hg=new k,Ul=new k,Bn=class extends un{constructor(t=new Ln,e=new kr){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}getVertexPosition(t,e){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,a=n.morphTargetsRelative;e.fromBufferAttribute(s,t);let o=this.morphTargetInfluences;if(r&&o){Ol.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=o[l],u=r[l];h!==0&&(Af.fromBufferAttribute(u,t),a?Ol.addScaledVector(Af,h):Ol.addScaledVector(Af.sub(e),h))}e.add(Ol)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Il.copy(n.boundingSphere),Il.applyMatrix4(r),Bs.copy(t.ray).recast(t.near),!(Il.containsPoint(Bs.origin)===!1&&(Bs.intersectSphere(Il,Vg)===null||Bs.origin.distanceToSquared(Vg)>(t.far-t.near)**2))&&(Gg.copy(r).invert(),Bs.copy(t.ray).applyMatrix4(Gg),!(n.boundingBox!==null&&Bs.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,Bs)))}_computeIntersections(t,e,n){let s,r=this.geometry,a=this.material,o=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,d=r.drawRange;if(o!==null)if(Array.isArray(a))for(let p=0,_=f.length;p<_;p++){let m=f[p],g=a[m.materialIndex],x=Math.max(m.start,d.start),w=Math.min(o.count,Math.min(m.start+m.count,d.start+d.count));for(let M=x,E=w;M<E;M+=3){let T=o.getX(M),y=o.getX(M+1),A=o.getX(M+2);s=Fl(this,g,t,n,c,h,u,T,y,A),s&&(s.faceIndex=Math.floor(M/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let p=Math.max(0,d.start),_=Math.min(o.count,d.start+d.count);for(let m=p,g=_;m<g;m+=3){let x=o.getX(m),w=o.getX(m+1),M=o.getX(m+2);s=Fl(this,a,t,n,c,h,u,x,w,M),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(a))for(let p=0,_=f.length;p<_;p++){let m=f[p],g=a[m.materialIndex],x=Math.max(m.start,d.start),w=Math.min(l.count,Math.min(m.start+m.count,d.start+d.count));for(let M=x,E=w;M<E;M+=3){let T=M,y=M+1,A=M+2;s=Fl(this,g,t,n,c,h,u,T,y,A),s&&(s.faceIndex=Math.floor(M/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let p=Math.max(0,d.start),_=Math.min(l.count,d.start+d.count);for(let m=p,g=_;m<g;m+=3){let x=m,w=m+1,M=m+2;s=Fl(this,a,t,n,c,h,u,x,w,M),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}}};function vw(i,t,e,n,s,r,a,o){let l;if(t.side===Nn?l=n.intersectTriangle(a,r,s,!0,o):l=n.intersectTriangle(s,r,a,t.side===_s,o),l===null)return null;Ul.copy(o),Ul.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(Ul);return c<e.near||c>e.far?null:{distance:c,point:Ul.clone(),object:i}}function Fl(i,t,e,n,s,r,a,o,l,c){i.getVertexPosition(o,Ll),i.getVertexPosition(l,Nl),i.getVertexPosition(c,Dl);let h=vw(i,t,e,n,Ll,Nl,Dl,Hg);if(h){let u=new k;cs.getBarycoord(Hg,Ll,Nl,Dl,u),s&&(h.uv=cs.getInterpolatedAttribute(s,o,l,c,u,new zt)),r&&(h.uv1=cs.getInterpolatedAttribute(r,o,l,c,u,new zt)),a&&(h.normal=cs.getInterpolatedAttribute(a,o,l,c,u,new k),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let f={a:o,b:l,c,normal:new k,materialIndex:0};cs.getNormal(Ll,Nl,Dl,f.normal),h.face=f,h.barycoord=u}return h}var Da=new Se,Wg=new Se,Xg=new Se,Mw=new Se,$g=new re,Bl=new k,Tf=new Xi,qg=new re,Rf=new $i,Ya=class extends Bn{constructor(t,e){super(t,e),this.isSkinnedMesh=!0,this.type="SkinnedMesh",this.bindMode=If,this.bindMatrix=new re,this.bindMatrixInverse=new re,this.boundingBox=null,this.boundingSphere=null}computeBoundingBox(){let t=this.geometry;this.boundingBox===null&&(this.boundingBox=new Wi),this.boundingBox.makeEmpty();let e=t.getAttribute("position");for(let n=0;n<e.count;n++)this.getVertexPosition(n,Bl),this.boundingBox.expandByPoint(Bl)}computeBoundingSphere(){let t=this.geometry;this.boundingSphere===null&&(this.boundingSphere=new Xi),this.boundingSphere.makeEmpty();let e=t.getAttribute("position");for(let n=0;n<e.count;n++)this.getVertexPosition(n,Bl),this.boundingSphere.expandByPoint(Bl)}copy(t,e){return super.copy(t,e),this.bindMode=t.bindMode,this.bindMatrix.copy(t.bindMatrix),this.bindMatrixInverse.copy(t.bindMatrixInverse),this.skeleton=t.skeleton,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}raycast(t,e){let n=this.material,s=this.matrixWorld;n!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Tf.copy(this.boundingSphere),Tf.applyMatrix4(s),t.ray.intersectsSphere(Tf)!==!1&&(qg.copy(s).invert(),Rf.copy(t.ray).applyMatrix4(qg),!(this.boundingBox!==null&&Rf.intersectsBox(this.boundingBox)===!1)&&this._computeIntersections(t,e,Rf)))}getVertexPosition(t,e){return super.getVertexPosition(t,e),this.applyBoneTransform(t,e),e}bind(t,e){this.skeleton=t,e===void 0&&(this.updateMatrixWorld(!0),this.skeleton.calculateInverses(),e=this.matrixWorld),this.bindMatrix.copy(e),this.bindMatrixInverse.copy(e).invert()}pose(){this.skeleton.pose()}normalizeSkinWeights(){let t=new Se,e=this.geometry.attributes.skinWeight;for(let n=0,s=e.count;n<s;n++){t.fromBufferAttribute(e,n);let r=1/t.manhattanLength();r!==1/0?t.multiplyScalar(r):t.set(1,0,0,0),e.setXYZW(n,t.x,t.y,t.z,t.w)}}updateMatrixWorld(t){super.updateMatrixWorld(t),this.bindMode===If?this.bindMatrixInverse.copy(this.matrixWorld).invert():this.bindMode===L0?this.bindMatrixInverse.copy(this.bindMatrix).invert():Ut("SkinnedMesh: Unrecognized bindMode: "+this.bindMode)}applyBoneTransform(t,e){let n=this.skeleton,s=this.geometry;Wg.fromBufferAttribute(s.attributes.skinIndex,t),Xg.fromBufferAttribute(s.attributes.skinWeight,t),e.isVector4?(Da.copy(e),e.set(0,0,0,0)):(Da.set(e.x,e.y,e.z,1),e.set(0,0,0)),Da.applyMatrix4(this.bindMatrix);for(let r=0;r<4;r++){let a=Xg.getComponent(r);if(a!==0){let o=Wg.getComponent(r);$g.multiplyMatrices(n.bones[o].matrixWorld,n.boneInverses[o]),e.addScaledVector(Mw.copy(Da).applyMatrix4($g),a)}}return e.isVector4&&(e.w=Da.w),e.applyMatrix4(this.bindMatrixInverse)}},zr=class extends un{constructor(){super(),this.isBone=!0,this.type="Bone"}},Za=class extends Fn{constructor(t=null,e=1,n=1,s,r,a,o,l,c=hn,h=hn,u,f){super(null,a,o,l,c,h,s,r,u,f),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}},Yg=new re,ww=new re,Ja=class i{constructor(t=[],e=[]){this.uuid=Ys(),this.bones=t.slice(0),this.boneInverses=e,this.boneMatrices=null,this.previousBoneMatrices=null,this.boneTexture=null,this.previousBoneTexture=null,this.init()}init(){let t=this.bones,e=this.boneInverses;if(this.boneMatrices=new Float32Array(t.length*16),e.length===0)this.calculateInverses();else if(t.length!==e.length){Ut("Skeleton: Number of inverse bone matrices does not match amount of bones."),this.boneInverses=[];for(let n=0,s=this.bones.length;n<s;n++)this.boneInverses.push(new re)}}calculateInverses(){this.boneInverses.length=0;for(let t=0,e=this.bones.length;t<e;t++){let n=new re;this.bones[t]&&n.copy(this.bones[t].matrixWorld).invert(),this.boneInverses.push(n)}}pose(){for(let t=0,e=this.bones.length;t<e;t++){let n=this.bones[t];n&&n.matrixWorld.copy(this.boneInverses[t]).invert()}for(let t=0,e=this.bones.length;t<e;t++){let n=this.bones[t];n&&(n.parent&&n.parent.isBone?(n.matrix.copy(n.parent.matrixWorld).invert(),n.matrix.multiply(n.matrixWorld)):n.matrix.copy(n.matrixWorld),n.matrix.decompose(n.position,n.quaternion,n.scale))}}update(){let t=this.bones,e=this.boneInverses,n=this.boneMatrices,s=this.boneTexture;for(let r=0,a=t.length;r<a;r++){let o=t[r]?t[r].matrixWorld:ww;Yg.multiplyMatrices(o,e[r]),Yg.toArray(n,r*16)}s!==null&&(s.needsUpdate=!0)}clone(){return new i(this.bones,this.boneInverses)}computeBoneTexture(){let t=Math.sqrt(this.bones.length*4);t=Math.ceil(t/4)*4,t=Math.max(t,4);let e=new Float32Array(t*t*4);e.set(this.boneMatrices);let n=new Za(e,t,t,ri,si);return n.needsUpdate=!0,this.boneMatrices=e,this.boneTexture=n,this}getBoneByName(t){for(let e=0,n=this.bones.length;e<n;e++){let s=this.bones[e];if(s.name===t)return s}}dispose(){this.boneTexture!==null&&(this.boneTexture.dispose(),this.boneTexture=null),this.previousBoneTexture!==null&&(this.previousBoneTexture.dispose(),this.previousBoneTexture=null)}fromJSON(t,e){this.uuid=t.uuid;for(let n=0,s=t.bones.length;n<s;n++){let r=t.bones[n],a=e[r];a===void 0&&(Ut("Skeleton: No bone found with UUID:",r),a=new zr),this.bones.push(a),this.boneInverses.push(new re().fromArray(t.boneInverses[n]))}return this.init(),this}toJSON(){let t={metadata:{version:4.7,type:"Skeleton",generator:"Skeleton.toJSON"},bones:[],boneInverses:[]};t.uuid=this.uuid;let e=this.bones,n=this.boneInverses;for(let s=0,r=e.length;s<r;s++){let a=e[s];t.bones.push(a.uuid);let o=n[s];t.boneInverses.push(o.toArray())}return t}};var ks=new Xi,bw=new zt(.5,.5),kl=new k,hs=class{constructor(t=new Cn,e=new Cn,n=new Cn,s=new Cn,r=new Cn,a=new Cn){this.planes=[t,e,n,s,r,a]}set(t,e,n,s,r,a){let o=this.planes;return o[0].copy(t),o[1].copy(e),o[2].copy(n),o[3].copy(s),o[4].copy(r),o[5].copy(a),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=ii,n=!1){let s=this.planes,r=t.elements,a=r[0],o=r[1],l=r[2],c=r[3],h=r[4],u=r[5],f=r[6],d=r[7],p=r[8],_=r[9],m=r[10],g=r[11],x=r[12],w=r[13],M=r[14],E=r[15];if(s[0].setComponents(c-a,d-h,g-p,E-x).normalize(),s[1].setComponents(c+a,d+h,g+p,E+x).normalize(),s[2].setComponents(c+o,d+u,g+_,E+w).normalize(),s[3].setComponents(c-o,d-u,g-_,E-w).normalize(),n)s[4].setComponents(l,f,m,M).normalize(),s[5].setComponents(c-l,d-f,g-m,E-M).normalize();else if(s[4].setComponents(c-l,d-f,g-m,E-M).normalize(),e===ii)s[5].setComponents(c+l,d+f,g+m,E+M).normalize();else if(e===Nr)s[5].setComponents(l,f,m,M).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),ks.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),ks.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(ks)}intersectsSprite(t){ks.center.set(0,0,0);let e=bw.distanceTo(t.center);return ks.radius=.7071067811865476+e,ks.applyMatrix4(t.matrixWorld),this.intersectsSphere(ks)}intersectsSphere(t){let e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let s=e[n];if(kl.x=s.normal.x>0?t.max.x:t.min.x,kl.y=s.normal.y>0?t.max.y:t.min.y,kl.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(kl)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Zg=new re,ac=class i{constructor(){this.coordinateSystem=ii,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,n=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];Zg.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new hs),n[s].setFromProjectionMatrix(Zg,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,n=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new hs),e[s].copy(n[s]);return this._count=t._count,this}clone(){return new i().copy(this)}};var Gs=class extends Ei{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Jt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},oc=new k,lc=new k,Jg=new re,Oa=new $i,zl=new Xi,Cf=new k,Kg=new k,Gr=class extends un{constructor(t=new Ln,e=new Gs){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)oc.fromBufferAttribute(e,s-1),lc.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=oc.distanceTo(lc);t.setAttribute("lineDistance",new dn(n,1))}else Ut("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,a=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),zl.copy(n.boundingSphere),zl.applyMatrix4(s),zl.radius+=r,t.ray.intersectsSphere(zl)===!1)return;Jg.copy(s).invert(),Oa.copy(t.ray).applyMatrix4(Jg);let o=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=o*o,c=this.isLineSegments?2:1,h=n.index,f=n.attributes.position;if(h!==null){let d=Math.max(0,a.start),p=Math.min(h.count,a.start+a.count);for(let _=d,m=p-1;_<m;_+=c){let g=h.getX(_),x=h.getX(_+1),w=Gl(this,t,Oa,l,g,x,_);w&&e.push(w)}if(this.isLineLoop){let _=h.getX(p-1),m=h.getX(d),g=Gl(this,t,Oa,l,_,m,p-1);g&&e.push(g)}}else{let d=Math.max(0,a.start),p=Math.min(f.count,a.start+a.count);for(let _=d,m=p-1;_<m;_+=c){let g=Gl(this,t,Oa,l,_,_+1,_);g&&e.push(g)}if(this.isLineLoop){let _=Gl(this,t,Oa,l,p-1,d,p-1);_&&e.push(_)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}};function Gl(i,t,e,n,s,r,a){let o=i.geometry.attributes.position;if(oc.fromBufferAttribute(o,s),lc.fromBufferAttribute(o,r),e.distanceSqToSegment(oc,lc,Cf,Kg)>n)return;Cf.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(Cf);if(!(c<t.near||c>t.far))return{distance:c,point:Kg.clone().applyMatrix4(i.matrixWorld),index:a,face:null,faceIndex:null,barycoord:null,object:i}}var jg=new k,Qg=new k,Ka=class extends Gr{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)jg.fromBufferAttribute(e,s),Qg.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+jg.distanceTo(Qg);t.setAttribute("lineDistance",new dn(n,1))}else Ut("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var ja=class extends Fn{constructor(t=[],e=$s,n,s,r,a,o,l,c,h){super(t,e,n,s,r,a,o,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var qi=class extends Fn{constructor(t,e,n=gi,s,r,a,o=hn,l=hn,c,h=Vi,u=1){if(h!==Vi&&h!==Zi)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:t,height:e,depth:u};super(f,s,r,a,o,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new Ur(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Qa=class extends qi{constructor(t,e=gi,n=$s,s,r,a=hn,o=hn,l,c=Vi){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,n,s,r,a,o,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},to=class extends Fn{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Vr=class i extends Ln{constructor(t=1,e=1,n=1,s=1,r=1,a=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:a};let o=this;s=Math.floor(s),r=Math.floor(r),a=Math.floor(a);let l=[],c=[],h=[],u=[],f=0,d=0;p("z","y","x",-1,-1,n,e,t,a,r,0),p("z","y","x",1,-1,n,e,-t,a,r,1),p("x","z","y",1,1,t,n,e,s,a,2),p("x","z","y",1,-1,t,n,-e,s,a,3),p("x","y","z",1,-1,t,e,n,s,r,4),p("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new dn(c,3)),this.setAttribute("normal",new dn(h,3)),this.setAttribute("uv",new dn(u,2));function p(_,m,g,x,w,M,E,T,y,A,F){let N=M/y,D=E/A,B=M/2,Z=E/2,P=T/2,$=y+1,Q=A+1,W=0,at=0,X=new k;for(let z=0;z<Q;z++){let it=z*D-Z;for(let Rt=0;Rt<$;Rt++){let kt=Rt*N-B;X[_]=kt*x,X[m]=it*w,X[g]=P,c.push(X.x,X.y,X.z),X[_]=0,X[m]=0,X[g]=T>0?1:-1,h.push(X.x,X.y,X.z),u.push(Rt/y),u.push(1-z/A),W+=1}}for(let z=0;z<A;z++)for(let it=0;it<y;it++){let Rt=f+it+$*z,kt=f+it+$*(z+1),et=f+(it+1)+$*(z+1),pt=f+(it+1)+$*z;l.push(Rt,kt,pt),l.push(kt,et,pt),at+=6}o.addGroup(d,at,F),d+=at,f+=W}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Vs=class i extends Ln{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};let r=t/2,a=e/2,o=Math.floor(n),l=Math.floor(s),c=o+1,h=l+1,u=t/o,f=e/l,d=[],p=[],_=[],m=[];for(let g=0;g<h;g++){let x=g*f-a;for(let w=0;w<c;w++){let M=w*u-r;p.push(M,-x,0),_.push(0,0,1),m.push(w/o),m.push(1-g/l)}}for(let g=0;g<l;g++)for(let x=0;x<o;x++){let w=x+c*g,M=x+c*(g+1),E=x+1+c*(g+1),T=x+1+c*g;d.push(w,M,T),d.push(M,E,T)}this.setIndex(d),this.setAttribute("position",new dn(p,3)),this.setAttribute("normal",new dn(_,3)),this.setAttribute("uv",new dn(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.widthSegments,t.heightSegments)}},eo=class i extends Ln{constructor(t=.5,e=1,n=32,s=1,r=0,a=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:n,phiSegments:s,thetaStart:r,thetaLength:a},n=Math.max(3,n),s=Math.max(1,s);let o=[],l=[],c=[],h=[],u=t,f=(e-t)/s,d=new k,p=new zt;for(let _=0;_<=s;_++){for(let m=0;m<=n;m++){let g=r+m/n*a;d.x=u*Math.cos(g),d.y=u*Math.sin(g),l.push(d.x,d.y,d.z),c.push(0,0,1),p.x=(d.x/e+1)/2,p.y=(d.y/e+1)/2,h.push(p.x,p.y)}u+=f}for(let _=0;_<s;_++){let m=_*(n+1);for(let g=0;g<n;g++){let x=g+m,w=x,M=x+n+1,E=x+n+2,T=x+1;o.push(w,M,T),o.push(M,E,T)}}this.setIndex(o),this.setAttribute("position",new dn(l,3)),this.setAttribute("normal",new dn(c,3)),this.setAttribute("uv",new dn(h,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}};var no=class extends Ei{constructor(t){super(),this.isShadowMaterial=!0,this.type="ShadowMaterial",this.color=new Jt(0),this.transparent=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.fog=t.fog,this}};function Zs(i){let t={};for(let e in i){t[e]={};for(let n in i[e]){let s=i[e][n];if(t0(s))s.isRenderTargetTexture?(Ut("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone();else if(Array.isArray(s))if(t0(s[0])){let r=[];for(let a=0,o=s.length;a<o;a++)r[a]=s[a].clone();t[e][n]=r}else t[e][n]=s.slice();else t[e][n]=s}}return t}function wn(i){let t={};for(let e=0;e<i.length;e++){let n=Zs(i[e]);for(let s in n)t[s]=n[s]}return t}function t0(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function Sw(i){let t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function gd(i){let t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:he.workingColorSpace}var J0={clone:Zs,merge:wn},Ew=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Aw=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Ai=class extends Ei{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Ew,this.fragmentShader=Aw,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Zs(t.uniforms),this.uniformsGroups=Sw(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let a=this.uniforms[s].value;a&&a.isTexture?e.uniforms[s]={type:"t",value:a.toJSON(t).uuid}:a&&a.isColor?e.uniforms[s]={type:"c",value:a.getHex()}:a&&a.isVector2?e.uniforms[s]={type:"v2",value:a.toArray()}:a&&a.isVector3?e.uniforms[s]={type:"v3",value:a.toArray()}:a&&a.isVector4?e.uniforms[s]={type:"v4",value:a.toArray()}:a&&a.isMatrix3?e.uniforms[s]={type:"m3",value:a.toArray()}:a&&a.isMatrix4?e.uniforms[s]={type:"m4",value:a.toArray()}:e.uniforms[s]={value:a}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let n in t.uniforms){let s=t.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=e[s.value]||null;break;case"c":this.uniforms[n].value=new Jt().setHex(s.value);break;case"v2":this.uniforms[n].value=new zt().fromArray(s.value);break;case"v3":this.uniforms[n].value=new k().fromArray(s.value);break;case"v4":this.uniforms[n].value=new Se().fromArray(s.value);break;case"m3":this.uniforms[n].value=new Yt().fromArray(s.value);break;case"m4":this.uniforms[n].value=new re().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let n in t.extensions)this.extensions[n]=t.extensions[n];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},cc=class extends Ai{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var io=class extends Ei{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Jt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Jt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=hh,this.normalScale=new zt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Hi,this.combine=Sc,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},hc=class extends Ei{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=D0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},uc=class extends Ei{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function Rr(i,t){return!i||i.constructor===t?i:typeof t.BYTES_PER_ELEMENT=="number"?new t(i):Array.prototype.slice.call(i)}function Vl(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var us=class{constructor(t,e,n,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,s=e[n],r=e[n-1];t:{e:{let a;n:{i:if(!(t<s)){for(let o=n+2;;){if(s===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===o)break;if(r=s,s=e[++n],t<s)break e}a=e.length;break n}if(!(t>=r)){let o=e[1];t<o&&(n=2,r=o);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=e[--n-1],t>=r)break e}a=n,n=0;break n}break t}for(;n<a;){let o=n+a>>>1;t<e[o]?a=o:n=o+1}if(s=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=t*s;for(let a=0;a!==s;++a)e[a]=n[r+a];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},fc=class extends us{constructor(t,e,n,s){super(t,e,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Nf,endingEnd:Nf}}intervalChanged_(t,e,n){let s=this.parameterPositions,r=t-2,a=t+1,o=s[r],l=s[a];if(o===void 0)switch(this.getSettings_().endingStart){case Df:r=t,o=2*e-n;break;case Of:r=s.length-2,o=e+s[r]-s[r+1];break;default:r=t,o=n}if(l===void 0)switch(this.getSettings_().endingEnd){case Df:a=t,l=2*n-e;break;case Of:a=1,l=n+s[1]-s[0];break;default:a=t-1,l=e}let c=(n-e)*.5,h=this.valueSize;this._weightPrev=c/(e-o),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=a*h}interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=this._offsetPrev,u=this._offsetNext,f=this._weightPrev,d=this._weightNext,p=(n-e)/(s-e),_=p*p,m=_*p,g=-f*m+2*f*_-f*p,x=(1+f)*m+(-1.5-2*f)*_+(-.5+f)*p+1,w=(-1-d)*m+(1.5+d)*_+.5*p,M=d*m-d*_;for(let E=0;E!==o;++E)r[E]=g*a[h+E]+x*a[c+E]+w*a[l+E]+M*a[u+E];return r}},dc=class extends us{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=(n-e)/(s-e),u=1-h;for(let f=0;f!==o;++f)r[f]=a[c+f]*u+a[l+f]*h;return r}},pc=class extends us{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t){return this.copySampleValue_(t-1)}},mc=class extends us{interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=this.inTangents,u=this.outTangents;if(!h||!u){let p=(n-e)/(s-e),_=1-p;for(let m=0;m!==o;++m)r[m]=a[c+m]*_+a[l+m]*p;return r}let f=o*2,d=t-1;for(let p=0;p!==o;++p){let _=a[c+p],m=a[l+p],g=d*f+p*2,x=u[g],w=u[g+1],M=t*f+p*2,E=h[M],T=h[M+1],y=Rw(n,e,x,E,s);r[p]=K0(y,_,w,T,m)}return r}};function K0(i,t,e,n,s){let r=1-i;return r*r*r*t+3*r*r*i*e+3*r*i*i*n+i*i*i*s}function Tw(i,t,e,n,s){let r=1-i;return 3*r*r*(e-t)+6*r*i*(n-e)+3*i*i*(s-n)}function Rw(i,t,e,n,s){let r=(i-t)/(s-t);for(let a=0;a<8;a++){let o=K0(r,t,e,n,s)-i;if(Math.abs(o)<1e-10)break;let l=Tw(r,t,e,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-o/l))}return r}var Zn=class{constructor(t,e,n,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=Rr(e,this.TimeBufferType),this.values=Rr(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:Rr(t.times,Array),values:Rr(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(n.interpolation=s),Vl(t.settings)&&(n.settings={inTangents:Rr(t.settings.inTangents,Array),outTangents:Rr(t.settings.outTangents,Array)})}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new pc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new dc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new fc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new mc(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case ka:e=this.InterpolantFactoryMethodDiscrete;break;case nc:e=this.InterpolantFactoryMethodLinear;break;case Xl:e=this.InterpolantFactoryMethodSmooth;break;case Lf:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Ut("KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return ka;case this.InterpolantFactoryMethodLinear:return nc;case this.InterpolantFactoryMethodSmooth:return Xl;case this.InterpolantFactoryMethodBezier:return Lf}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]+=t;Vl(this.settings)&&(e0(this.settings.inTangents,t),e0(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]*=t;Vl(this.settings)&&(n0(this.settings.inTangents,t),n0(this.settings.outTangents,t))}return this}trim(t,e){let n=this.times,s=n.length,r=0,a=s-1;for(;r!==s&&n[r]<t;)++r;for(;a!==-1&&n[a]>e;)--a;if(++a,r!==0||a!==s){r>=a&&(a=Math.max(a,1),r=a-1);let o=this.getValueSize();this.times=n.slice(r,a),this.values=this.values.slice(r*o,a*o)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Wt("KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,s=this.values,r=n.length;r===0&&(Wt("KeyframeTrack: Track is empty.",this),t=!1);let a=null;for(let o=0;o!==r;o++){let l=n[o];if(typeof l=="number"&&isNaN(l)){Wt("KeyframeTrack: Time is not a valid number.",this,o,l),t=!1;break}if(a!==null&&a>l){Wt("KeyframeTrack: Out of order keys.",this,o,l,a),t=!1;break}a=l}if(s!==void 0&&VM(s))for(let o=0,l=s.length;o!==l;++o){let c=s[o];if(isNaN(c)){Wt("KeyframeTrack: Value is not a valid number.",this,o,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Xl,r=t.length-1,a=1;for(let o=1;o<r;++o){let l=!1,c=t[o],h=t[o+1];if(c!==h&&(o!==1||c!==t[0]))if(s)l=!0;else{let u=o*n,f=u-n,d=u+n;for(let p=0;p!==n;++p){let _=e[u+p];if(_!==e[f+p]||_!==e[d+p]){l=!0;break}}}if(l){if(o!==a){t[a]=t[o];let u=o*n,f=a*n;for(let d=0;d!==n;++d)e[f+d]=e[u+d]}++a}}if(r>0){t[a]=t[r];for(let o=r*n,l=a*n,c=0;c!==n;++c)e[l+c]=e[o+c];++a}return a!==t.length?(this.times=t.slice(0,a),this.values=e.slice(0,a*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,s=new n(this.name,t,e);return s.createInterpolant=this.createInterpolant,Vl(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function e0(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]+=t}function n0(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]*=t}Zn.prototype.ValueTypeName="";Zn.prototype.TimeBufferType=Float32Array;Zn.prototype.ValueBufferType=Float32Array;Zn.prototype.DefaultInterpolation=nc;var fs=class extends Zn{constructor(t,e,n){super(t,e,n)}};fs.prototype.ValueTypeName="bool";fs.prototype.ValueBufferType=Array;fs.prototype.DefaultInterpolation=ka;fs.prototype.InterpolantFactoryMethodLinear=void 0;fs.prototype.InterpolantFactoryMethodSmooth=void 0;var gc=class extends Zn{constructor(t,e,n,s){super(t,e,n,s)}};gc.prototype.ValueTypeName="color";var _c=class extends Zn{constructor(t,e,n,s){super(t,e,n,s)}};_c.prototype.ValueTypeName="number";var yc=class extends us{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=(n-e)/(s-e),c=t*o;for(let h=c+o;c!==h;c+=4)Mn.slerpFlat(r,0,a,c-o,a,c,l);return r}},so=class extends Zn{constructor(t,e,n,s){super(t,e,n,s)}InterpolantFactoryMethodLinear(t){return new yc(this.times,this.values,this.getValueSize(),t)}};so.prototype.ValueTypeName="quaternion";so.prototype.InterpolantFactoryMethodSmooth=void 0;var ds=class extends Zn{constructor(t,e,n){super(t,e,n)}};ds.prototype.ValueTypeName="string";ds.prototype.ValueBufferType=Array;ds.prototype.DefaultInterpolation=ka;ds.prototype.InterpolantFactoryMethodLinear=void 0;ds.prototype.InterpolantFactoryMethodSmooth=void 0;var xc=class extends Zn{constructor(t,e,n,s){super(t,e,n,s)}};xc.prototype.ValueTypeName="vector";var vc=class{constructor(t,e,n){let s=this,r=!1,a=0,o=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this._abortController=null,this.itemStart=function(h){o++,r===!1&&s.onStart!==void 0&&s.onStart(h,a,o),r=!0},this.itemEnd=function(h){a++,s.onProgress!==void 0&&s.onProgress(h,a,o),a===o&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,f=c.length;u<f;u+=2){let d=c[u],p=c[u+1];if(d.global&&(d.lastIndex=0),d.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},j0=new vc,Mc=class{constructor(t){this.manager=t!==void 0?t:j0,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let n=this;return new Promise(function(s,r){n.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};Mc.DEFAULT_MATERIAL_NAME="__DEFAULT";var Hr=class extends un{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new Jt(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}},ro=class extends Hr{constructor(t,e,n){super(t,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(un.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Jt(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}toJSON(t){let e=super.toJSON(t);return e.object.groundColor=this.groundColor.getHex(),e}},Pf=new re,i0=new k,s0=new k,wc=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new zt(512,512),this.mapType=kn,this.map=null,this.mapPass=null,this.matrix=new re,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new hs,this._frameExtents=new zt(1,1),this._viewportCount=1,this._viewports=[new Se(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;i0.setFromMatrixPosition(t.matrixWorld),e.position.copy(i0),s0.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(s0),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,n,s){Pf.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),n.setFromProjectionMatrix(Pf,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,a=s?s.z/r.x:1,o=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;t.coordinateSystem===Nr||t.reversedDepth?e.set(.5*a,0,0,.5*a+l,0,.5*o,0,.5*o+c,0,0,1,0,0,0,0,1):e.set(.5*a,0,0,.5*a+l,0,.5*o,0,.5*o+c,0,0,.5,.5,0,0,0,1),e.multiply(Pf)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},Hl=new k,Wl=new Mn,bi=new k,ao=class extends un{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new re,this.projectionMatrix=new re,this.projectionMatrixInverse=new re,this.coordinateSystem=ii,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(Hl,Wl,bi),bi.x===1&&bi.y===1&&bi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Hl,Wl,bi.set(1,1,1)).invert()}updateWorldMatrix(t,e,n=!1){super.updateWorldMatrix(t,e,n),this.matrixWorld.decompose(Hl,Wl,bi),bi.x===1&&bi.y===1&&bi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Hl,Wl,bi.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ls=new k,r0=new zt,a0=new zt,Pn=class extends ao{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Or*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(Fa*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Or*2*Math.atan(Math.tan(Fa*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){ls.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(ls.x,ls.y).multiplyScalar(-t/ls.z),ls.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ls.x,ls.y).multiplyScalar(-t/ls.z)}getViewSize(t,e){return this.getViewBounds(t,r0,a0),e.subVectors(a0,r0)}setViewOffset(t,e,n,s,r,a){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(Fa*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s,a=this.view;if(this.view!==null&&this.view.enabled){let l=a.fullWidth,c=a.fullHeight;r+=a.offsetX*s/l,e-=a.offsetY*n/c,s*=a.width/l,n*=a.height/c}let o=this.filmOffset;o!==0&&(r+=t*o/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var oo=class extends ao{constructor(t=-1,e=1,n=1,s=-1,r=.1,a=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=a,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,a){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-t,a=n+t,o=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,a=r+c*this.view.width,o-=h*this.view.offsetY,l=o-h*this.view.height}this.projectionMatrix.makeOrthographic(r,a,o,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},Uf=class extends wc{constructor(){super(new oo(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},lo=class extends Hr{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(un.DEFAULT_UP),this.updateMatrix(),this.target=new un,this.shadow=new Uf}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}},co=class extends Hr{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}};var Cr=-90,Pr=1,Wr=class extends un{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Pn(Cr,Pr,t,e);s.layers=this.layers,this.add(s);let r=new Pn(Cr,Pr,t,e);r.layers=this.layers,this.add(r);let a=new Pn(Cr,Pr,t,e);a.layers=this.layers,this.add(a);let o=new Pn(Cr,Pr,t,e);o.layers=this.layers,this.add(o);let l=new Pn(Cr,Pr,t,e);l.layers=this.layers,this.add(l);let c=new Pn(Cr,Pr,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,s,r,a,o,l]=e;for(let c of e)this.remove(c);if(t===ii)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),a.up.set(0,0,1),a.lookAt(0,-1,0),o.up.set(0,1,0),o.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Nr)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),a.up.set(0,0,-1),a.lookAt(0,-1,0),o.up.set(0,-1,0),o.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,a,o,l,c,h]=this.children,u=t.getRenderTarget(),f=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),p=t.xr.enabled;t.xr.enabled=!1;let _=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let m=!1;t.isWebGLRenderer===!0?m=t.state.buffers.depth.getReversed():m=t.reversedDepthBuffer,t.setRenderTarget(n,0,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(n,1,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(n,2,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(n,3,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(n,4,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),n.texture.mipmapsAutoUpdate=_,t.setRenderTarget(n,5,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,f,d),t.xr.enabled=p,n.texture.needsPMREMUpdate=!0}},bc=class extends Pn{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var _d="\\[\\]\\.:\\/",Cw=new RegExp("["+_d+"]","g"),yd="[^"+_d+"]",Pw="[^"+_d.replace("\\.","")+"]",Iw=/((?:WC+[\/:])*)/.source.replace("WC",yd),Lw=/(WCOD+)?/.source.replace("WCOD",Pw),Nw=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",yd),Dw=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",yd),Ow=new RegExp("^"+Iw+Lw+Nw+Dw+"$"),Uw=["material","materials","bones","map"],Ff=class{constructor(t,e,n){let s=n||Oe.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},Oe=class i{constructor(t,e,n){this.path=e,this.parsedPath=n||i.parseTrackName(e),this.node=i.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new i.Composite(t,e,n):new i(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(Cw,"")}static parseTrackName(t){let e=Ow.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);Uw.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let a=0;a<r.length;a++){let o=r[a];if(o.name===e||o.uuid===e)return o;let l=n(o.children);if(l)return l}return null},s=n(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)t[e++]=n[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=i.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Ut("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){Wt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Wt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Wt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Wt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Wt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){Wt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){Wt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let a=t[s];if(a===void 0){let c=e.nodeName;Wt("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let o=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?o=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(o=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Wt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Wt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=a,this.propertyIndex=r}else a.fromArray!==void 0&&a.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=a):Array.isArray(a)?(l=this.BindingType.EntireArray,this.resolvedProperty=a):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][o]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Oe.Composite=Ff;Oe.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Oe.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Oe.prototype.GetterByBindingType=[Oe.prototype._getValue_direct,Oe.prototype._getValue_array,Oe.prototype._getValue_arrayElement,Oe.prototype._getValue_toArray];Oe.prototype.SetterByBindingTypeAndVersioning=[[Oe.prototype._setValue_direct,Oe.prototype._setValue_direct_setNeedsUpdate,Oe.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Oe.prototype._setValue_array,Oe.prototype._setValue_array_setNeedsUpdate,Oe.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Oe.prototype._setValue_arrayElement,Oe.prototype._setValue_arrayElement_setNeedsUpdate,Oe.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Oe.prototype._setValue_fromArray,Oe.prototype._setValue_fromArray_setNeedsUpdate,Oe.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var HR=new Float32Array(1);var o0=new re,ho=class{constructor(t,e,n=0,s=1/0){this.ray=new $i(t,e),this.near=n,this.far=s,this.camera=null,this.layers=new Fr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Wt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return o0.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(o0),this}intersectObject(t,e=!0,n=[]){return Bf(t,this,n,e),n.sort(l0),n}intersectObjects(t,e=!0,n=[]){for(let s=0,r=t.length;s<r;s++)Bf(t[s],this,n,e);return n.sort(l0),n}};function l0(i,t){return i.distance-t.distance}function Bf(i,t,e,n){let s=!0;if(i.layers.test(t.layers)&&i.raycast(t,e)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let a=0,o=r.length;a<o;a++)Bf(r[a],t,e,!0)}}var ps=class{constructor(t=1,e=0,n=0){this.radius=t,this.phi=e,this.theta=n}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=se(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(se(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var kf=class{static{this.prototype.isMatrix2=!0}constructor(t,e,n,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let n=0;n<4;n++)this.elements[n]=t[n+e];return this}set(t,e,n,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=n,r[3]=s,this}};var uo=class extends mi{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function xd(i,t,e,n){let s=Fw(n);switch(e){case sd:return i*t;case ad:return i*t/s.components*s.byteLength;case Ic:return i*t/s.components*s.byteLength;case ys:return i*t*2/s.components*s.byteLength;case Lc:return i*t*2/s.components*s.byteLength;case rd:return i*t*3/s.components*s.byteLength;case ri:return i*t*4/s.components*s.byteLength;case Nc:return i*t*4/s.components*s.byteLength;case po:case mo:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case go:case _o:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Oc:case Fc:return Math.max(i,16)*Math.max(t,8)/4;case Dc:case Uc:return Math.max(i,8)*Math.max(t,8)/2;case Bc:case kc:case Gc:case Vc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case zc:case yo:case Hc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Wc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Xc:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case $c:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case qc:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case Yc:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case Zc:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case Jc:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case Kc:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case jc:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case Qc:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case th:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case eh:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case nh:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case ih:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case sh:case rh:case ah:return Math.ceil(i/4)*Math.ceil(t/4)*16;case oh:case lh:return Math.ceil(i/4)*Math.ceil(t/4)*8;case xo:case ch:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function Fw(i){switch(i){case kn:case td:return{byteLength:1,components:1};case Yr:case ed:case _i:return{byteLength:2,components:1};case Cc:case Pc:return{byteLength:2,components:4};case gi:case Rc:case si:return{byteLength:4,components:1};case nd:case id:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Ut("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function v_(){let i=null,t=!1,e=null,n=null;function s(r,a){n=i.requestAnimationFrame(s),e(r,a)}return{start:function(){t!==!0&&e!==null&&i!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function kw(i){let t=new WeakMap;function e(o,l){let c=o.array,h=o.usage,u=c.byteLength,f=i.createBuffer();i.bindBuffer(l,f),i.bufferData(l,c,h),o.onUploadCallback();let d;if(c instanceof Float32Array)d=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)d=i.HALF_FLOAT;else if(c instanceof Uint16Array)o.isFloat16BufferAttribute?d=i.HALF_FLOAT:d=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)d=i.SHORT;else if(c instanceof Uint32Array)d=i.UNSIGNED_INT;else if(c instanceof Int32Array)d=i.INT;else if(c instanceof Int8Array)d=i.BYTE;else if(c instanceof Uint8Array)d=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)d=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:f,type:d,bytesPerElement:c.BYTES_PER_ELEMENT,version:o.version,size:u}}function n(o,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,o),u.length===0)i.bufferSubData(c,0,h);else{u.sort((d,p)=>d.start-p.start);let f=0;for(let d=1;d<u.length;d++){let p=u[f],_=u[d];_.start<=p.start+p.count+1?p.count=Math.max(p.count,_.start+_.count-p.start):(++f,u[f]=_)}u.length=f+1;for(let d=0,p=u.length;d<p;d++){let _=u[d];i.bufferSubData(c,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(o){return o.isInterleavedBufferAttribute&&(o=o.data),t.get(o)}function r(o){o.isInterleavedBufferAttribute&&(o=o.data);let l=t.get(o);l&&(i.deleteBuffer(l.buffer),t.delete(o))}function a(o,l){if(o.isInterleavedBufferAttribute&&(o=o.data),o.isGLBufferAttribute){let h=t.get(o);(!h||h.version<o.version)&&t.set(o,{buffer:o.buffer,type:o.type,bytesPerElement:o.elementSize,version:o.version});return}let c=t.get(o);if(c===void 0)t.set(o,e(o,l));else if(c.version<o.version){if(c.size!==o.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,o,l),c.version=o.version}}return{get:s,remove:r,update:a}}var zw=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Gw=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,Vw=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Hw=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Ww=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Xw=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,$w=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,qw=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Yw=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,Zw=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Jw=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Kw=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,jw=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,Qw=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,tb=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,eb=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,nb=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,ib=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,sb=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,rb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,ab=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,ob=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,lb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,cb=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,hb=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,ub=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,fb=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,db=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,pb=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,mb="gl_FragColor = linearToOutputTexel( gl_FragColor );",gb=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,_b=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,yb=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,xb=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,vb=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Mb=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,wb=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,bb=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,Sb=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Eb=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,Ab=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,Tb=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Rb=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Cb=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,Pb=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,Ib=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,Lb=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Nb=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,Db=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,Ob=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,Ub=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,Fb=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,Bb=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,kb=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,zb=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,Gb=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,Vb=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,Hb=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Wb=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Xb=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,$b=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,qb=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,Yb=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,Zb=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Jb=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,Kb=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,jb=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,Qb=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,tS=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,eS=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,nS=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,iS=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,sS=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,rS=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,aS=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,oS=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,lS=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,cS=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,hS=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,uS=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,fS=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,dS=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,pS=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,mS=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,gS=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,_S=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,yS=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,xS=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,vS=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,MS=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,wS=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,bS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,SS=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,ES=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,AS=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,TS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,RS=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,CS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,PS=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,IS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,LS=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,NS=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,DS=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,OS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,US=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,FS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,BS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,kS=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,zS=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,GS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,VS=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,HS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,WS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,XS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,$S=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,qS=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,YS=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,ZS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,JS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,KS=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,jS=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,QS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,t1=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,e1=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,n1=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,i1=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,s1=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,r1=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,a1=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,o1=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,l1=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,c1=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,h1=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,u1=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,f1=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,d1=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,p1=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,m1=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,g1=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,_1=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,y1=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,te={alphahash_fragment:zw,alphahash_pars_fragment:Gw,alphamap_fragment:Vw,alphamap_pars_fragment:Hw,alphatest_fragment:Ww,alphatest_pars_fragment:Xw,aomap_fragment:$w,aomap_pars_fragment:qw,batching_pars_vertex:Yw,batching_vertex:Zw,begin_vertex:Jw,beginnormal_vertex:Kw,bsdfs:jw,iridescence_fragment:Qw,bumpmap_pars_fragment:tb,clipping_planes_fragment:eb,clipping_planes_pars_fragment:nb,clipping_planes_pars_vertex:ib,clipping_planes_vertex:sb,color_fragment:rb,color_pars_fragment:ab,color_pars_vertex:ob,color_vertex:lb,common:cb,defaultnormal_vertex:hb,displacementmap_pars_vertex:ub,displacementmap_vertex:fb,emissivemap_fragment:db,emissivemap_pars_fragment:pb,colorspace_fragment:mb,colorspace_pars_fragment:gb,envmap_fragment:_b,envmap_common_pars_fragment:yb,envmap_pars_fragment:xb,envmap_pars_vertex:vb,envmap_physical_pars_fragment:Ib,envmap_vertex:Mb,fog_vertex:wb,fog_pars_vertex:bb,fog_fragment:Sb,fog_pars_fragment:Eb,gradientmap_pars_fragment:Ab,lightmap_pars_fragment:Tb,lights_lambert_fragment:Rb,lights_lambert_pars_fragment:Cb,lights_pars_begin:Pb,lights_toon_fragment:Lb,lights_toon_pars_fragment:Nb,lights_phong_fragment:Db,lights_phong_pars_fragment:Ob,lights_physical_fragment:Ub,lights_physical_pars_fragment:Fb,lights_fragment_begin:Bb,lights_fragment_maps:kb,lights_fragment_end:zb,lightprobes_pars_fragment:Gb,logdepthbuf_fragment:Vb,logdepthbuf_pars_fragment:Hb,logdepthbuf_pars_vertex:Wb,logdepthbuf_vertex:Xb,map_fragment:$b,map_pars_fragment:qb,map_particle_fragment:Yb,map_particle_pars_fragment:Zb,metalnessmap_fragment:Jb,metalnessmap_pars_fragment:Kb,morphinstance_vertex:jb,morphcolor_vertex:Qb,morphnormal_vertex:tS,morphtarget_pars_vertex:eS,morphtarget_vertex:nS,normal_fragment_begin:iS,normal_fragment_maps:sS,normal_pars_fragment:rS,normal_pars_vertex:aS,normal_vertex:oS,normalmap_pars_fragment:lS,clearcoat_normal_fragment_begin:cS,clearcoat_normal_fragment_maps:hS,clearcoat_pars_fragment:uS,iridescence_pars_fragment:fS,opaque_fragment:dS,packing:pS,premultiplied_alpha_fragment:mS,project_vertex:gS,dithering_fragment:_S,dithering_pars_fragment:yS,roughnessmap_fragment:xS,roughnessmap_pars_fragment:vS,shadowmap_pars_fragment:MS,shadowmap_pars_vertex:wS,shadowmap_vertex:bS,shadowmask_pars_fragment:SS,skinbase_vertex:ES,skinning_pars_vertex:AS,skinning_vertex:TS,skinnormal_vertex:RS,specularmap_fragment:CS,specularmap_pars_fragment:PS,tonemapping_fragment:IS,tonemapping_pars_fragment:LS,transmission_fragment:NS,transmission_pars_fragment:DS,uv_pars_fragment:OS,uv_pars_vertex:US,uv_vertex:FS,worldpos_vertex:BS,background_vert:kS,background_frag:zS,backgroundCube_vert:GS,backgroundCube_frag:VS,cube_vert:HS,cube_frag:WS,depth_vert:XS,depth_frag:$S,distance_vert:qS,distance_frag:YS,equirect_vert:ZS,equirect_frag:JS,linedashed_vert:KS,linedashed_frag:jS,meshbasic_vert:QS,meshbasic_frag:t1,meshlambert_vert:e1,meshlambert_frag:n1,meshmatcap_vert:i1,meshmatcap_frag:s1,meshnormal_vert:r1,meshnormal_frag:a1,meshphong_vert:o1,meshphong_frag:l1,meshphysical_vert:c1,meshphysical_frag:h1,meshtoon_vert:u1,meshtoon_frag:f1,points_vert:d1,points_frag:p1,shadow_vert:m1,shadow_frag:g1,sprite_vert:_1,sprite_frag:y1},Et={common:{diffuse:{value:new Jt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Yt},alphaMap:{value:null},alphaMapTransform:{value:new Yt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Yt}},envmap:{envMap:{value:null},envMapRotation:{value:new Yt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Yt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Yt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Yt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Yt},normalScale:{value:new zt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Yt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Yt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Yt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Yt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Jt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Jt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Yt},alphaTest:{value:0},uvTransform:{value:new Yt}},sprite:{diffuse:{value:new Jt(16777215)},opacity:{value:1},center:{value:new zt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Yt},alphaMap:{value:null},alphaMapTransform:{value:new Yt},alphaTest:{value:0}}},Pi={basic:{uniforms:wn([Et.common,Et.specularmap,Et.envmap,Et.aomap,Et.lightmap,Et.fog]),vertexShader:te.meshbasic_vert,fragmentShader:te.meshbasic_frag},lambert:{uniforms:wn([Et.common,Et.specularmap,Et.envmap,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.fog,Et.lights,{emissive:{value:new Jt(0)},envMapIntensity:{value:1}}]),vertexShader:te.meshlambert_vert,fragmentShader:te.meshlambert_frag},phong:{uniforms:wn([Et.common,Et.specularmap,Et.envmap,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.fog,Et.lights,{emissive:{value:new Jt(0)},specular:{value:new Jt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:te.meshphong_vert,fragmentShader:te.meshphong_frag},standard:{uniforms:wn([Et.common,Et.envmap,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.roughnessmap,Et.metalnessmap,Et.fog,Et.lights,{emissive:{value:new Jt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:te.meshphysical_vert,fragmentShader:te.meshphysical_frag},toon:{uniforms:wn([Et.common,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.gradientmap,Et.fog,Et.lights,{emissive:{value:new Jt(0)}}]),vertexShader:te.meshtoon_vert,fragmentShader:te.meshtoon_frag},matcap:{uniforms:wn([Et.common,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.fog,{matcap:{value:null}}]),vertexShader:te.meshmatcap_vert,fragmentShader:te.meshmatcap_frag},points:{uniforms:wn([Et.points,Et.fog]),vertexShader:te.points_vert,fragmentShader:te.points_frag},dashed:{uniforms:wn([Et.common,Et.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:te.linedashed_vert,fragmentShader:te.linedashed_frag},depth:{uniforms:wn([Et.common,Et.displacementmap]),vertexShader:te.depth_vert,fragmentShader:te.depth_frag},normal:{uniforms:wn([Et.common,Et.bumpmap,Et.normalmap,Et.displacementmap,{opacity:{value:1}}]),vertexShader:te.meshnormal_vert,fragmentShader:te.meshnormal_frag},sprite:{uniforms:wn([Et.sprite,Et.fog]),vertexShader:te.sprite_vert,fragmentShader:te.sprite_frag},background:{uniforms:{uvTransform:{value:new Yt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:te.background_vert,fragmentShader:te.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Yt}},vertexShader:te.backgroundCube_vert,fragmentShader:te.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:te.cube_vert,fragmentShader:te.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:te.equirect_vert,fragmentShader:te.equirect_frag},distance:{uniforms:wn([Et.common,Et.displacementmap,{referencePosition:{value:new k},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:te.distance_vert,fragmentShader:te.distance_frag},shadow:{uniforms:wn([Et.lights,Et.fog,{color:{value:new Jt(0)},opacity:{value:1}}]),vertexShader:te.shadow_vert,fragmentShader:te.shadow_frag}};Pi.physical={uniforms:wn([Pi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Yt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Yt},clearcoatNormalScale:{value:new zt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Yt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Yt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Yt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Yt},sheen:{value:0},sheenColor:{value:new Jt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Yt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Yt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Yt},transmissionSamplerSize:{value:new zt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Yt},attenuationDistance:{value:0},attenuationColor:{value:new Jt(0)},specularColor:{value:new Jt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Yt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Yt},anisotropyVector:{value:new zt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Yt}}]),vertexShader:te.meshphysical_vert,fragmentShader:te.meshphysical_frag};var uh={r:0,b:0,g:0},x1=new re,M_=new Yt;M_.set(-1,0,0,0,1,0,0,0,1);function v1(i,t,e,n,s,r){let a=new Jt(0),o=s===!0?0:1,l,c,h=null,u=0,f=null;function d(x){let w=x.isScene===!0?x.background:null;if(w&&w.isTexture){let M=x.backgroundBlurriness>0;w=t.get(w,M)}return w}function p(x){let w=!1,M=d(x);M===null?m(a,o):M&&M.isColor&&(m(M,1),w=!0);let E=i.xr.getEnvironmentBlendMode();E==="additive"?e.buffers.color.setClear(0,0,0,1,r):E==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(i.autoClear||w)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function _(x,w){let M=d(w);M&&M.isCubeTexture?(c===void 0&&(c=new Bn(new Vr(1,1,1),new Ai({name:"BackgroundCubeMaterial",uniforms:Zs(Pi.backgroundCube.uniforms),vertexShader:Pi.backgroundCube.vertexShader,fragmentShader:Pi.backgroundCube.fragmentShader,side:Nn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(E,T,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=M,c.material.uniforms.backgroundBlurriness.value=w.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(x1.makeRotationFromEuler(w.backgroundRotation)).transpose(),M.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(M_),c.material.toneMapped=he.getTransfer(M.colorSpace)!==we,(h!==M||u!==M.version||f!==i.toneMapping)&&(c.material.needsUpdate=!0,h=M,u=M.version,f=i.toneMapping),c.layers.enableAll(),x.unshift(c,c.geometry,c.material,0,0,null)):M&&M.isTexture&&(l===void 0&&(l=new Bn(new Vs(2,2),new Ai({name:"BackgroundMaterial",uniforms:Zs(Pi.background.uniforms),vertexShader:Pi.background.vertexShader,fragmentShader:Pi.background.fragmentShader,side:_s,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=M,l.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,l.material.toneMapped=he.getTransfer(M.colorSpace)!==we,M.matrixAutoUpdate===!0&&M.updateMatrix(),l.material.uniforms.uvTransform.value.copy(M.matrix),(h!==M||u!==M.version||f!==i.toneMapping)&&(l.material.needsUpdate=!0,h=M,u=M.version,f=i.toneMapping),l.layers.enableAll(),x.unshift(l,l.geometry,l.material,0,0,null))}function m(x,w){x.getRGB(uh,gd(i)),e.buffers.color.setClear(uh.r,uh.g,uh.b,w,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return a},setClearColor:function(x,w=1){a.set(x),o=w,m(a,o)},getClearAlpha:function(){return o},setClearAlpha:function(x){o=x,m(a,o)},render:p,addToRenderList:_,dispose:g}}function M1(i,t){let e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=f(null),r=s,a=!1;function o(D,B,Z,P,$){let Q=!1,W=u(D,P,Z,B);r!==W&&(r=W,c(r.object)),Q=d(D,P,Z,$),Q&&p(D,P,Z,$),$!==null&&t.update($,i.ELEMENT_ARRAY_BUFFER),(Q||a)&&(a=!1,M(D,B,Z,P),$!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get($).buffer))}function l(){return i.createVertexArray()}function c(D){return i.bindVertexArray(D)}function h(D){return i.deleteVertexArray(D)}function u(D,B,Z,P){let $=P.wireframe===!0,Q=n[B.id];Q===void 0&&(Q={},n[B.id]=Q);let W=D.isInstancedMesh===!0?D.id:0,at=Q[W];at===void 0&&(at={},Q[W]=at);let X=at[Z.id];X===void 0&&(X={},at[Z.id]=X);let z=X[$];return z===void 0&&(z=f(l()),X[$]=z),z}function f(D){let B=[],Z=[],P=[];for(let $=0;$<e;$++)B[$]=0,Z[$]=0,P[$]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:B,enabledAttributes:Z,attributeDivisors:P,object:D,attributes:{},index:null}}function d(D,B,Z,P){let $=r.attributes,Q=B.attributes,W=0,at=Z.getAttributes();for(let X in at)if(at[X].location>=0){let it=$[X],Rt=Q[X];if(Rt===void 0&&(X==="instanceMatrix"&&D.instanceMatrix&&(Rt=D.instanceMatrix),X==="instanceColor"&&D.instanceColor&&(Rt=D.instanceColor)),it===void 0||it.attribute!==Rt||Rt&&it.data!==Rt.data)return!0;W++}return r.attributesNum!==W||r.index!==P}function p(D,B,Z,P){let $={},Q=B.attributes,W=0,at=Z.getAttributes();for(let X in at)if(at[X].location>=0){let it=Q[X];it===void 0&&(X==="instanceMatrix"&&D.instanceMatrix&&(it=D.instanceMatrix),X==="instanceColor"&&D.instanceColor&&(it=D.instanceColor));let Rt={};Rt.attribute=it,it&&it.data&&(Rt.data=it.data),$[X]=Rt,W++}r.attributes=$,r.attributesNum=W,r.index=P}function _(){let D=r.newAttributes;for(let B=0,Z=D.length;B<Z;B++)D[B]=0}function m(D){g(D,0)}function g(D,B){let Z=r.newAttributes,P=r.enabledAttributes,$=r.attributeDivisors;Z[D]=1,P[D]===0&&(i.enableVertexAttribArray(D),P[D]=1),$[D]!==B&&(i.vertexAttribDivisor(D,B),$[D]=B)}function x(){let D=r.newAttributes,B=r.enabledAttributes;for(let Z=0,P=B.length;Z<P;Z++)B[Z]!==D[Z]&&(i.disableVertexAttribArray(Z),B[Z]=0)}function w(D,B,Z,P,$,Q,W){W===!0?i.vertexAttribIPointer(D,B,Z,$,Q):i.vertexAttribPointer(D,B,Z,P,$,Q)}function M(D,B,Z,P){_();let $=P.attributes,Q=Z.getAttributes(),W=B.defaultAttributeValues;for(let at in Q){let X=Q[at];if(X.location>=0){let z=$[at];if(z===void 0&&(at==="instanceMatrix"&&D.instanceMatrix&&(z=D.instanceMatrix),at==="instanceColor"&&D.instanceColor&&(z=D.instanceColor)),z!==void 0){let it=z.normalized,Rt=z.itemSize,kt=t.get(z);if(kt===void 0)continue;let et=kt.buffer,pt=kt.type,_t=kt.bytesPerElement,Nt=pt===i.INT||pt===i.UNSIGNED_INT||z.gpuType===Rc;if(z.isInterleavedBufferAttribute){let lt=z.data,Tt=lt.isInterleavedBuffer===!0?lt.stride:lt.itemSize,oe=z.offset;if(lt.isInstancedInterleavedBuffer||lt.isInstancedBufferAttribute){for(let Ft=0;Ft<X.locationSize;Ft++)g(X.location+Ft,lt.meshPerAttribute);D.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=lt.meshPerAttribute*lt.count)}else for(let Ft=0;Ft<X.locationSize;Ft++)m(X.location+Ft);i.bindBuffer(i.ARRAY_BUFFER,et);for(let Ft=0;Ft<X.locationSize;Ft++)w(X.location+Ft,Rt/X.locationSize,pt,it,Tt*_t,(oe+Rt/X.locationSize*Ft)*_t,Nt)}else{if(z.isInstancedBufferAttribute){for(let lt=0;lt<X.locationSize;lt++)g(X.location+lt,z.meshPerAttribute);D.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=z.meshPerAttribute*z.count)}else for(let lt=0;lt<X.locationSize;lt++)m(X.location+lt);i.bindBuffer(i.ARRAY_BUFFER,et);for(let lt=0;lt<X.locationSize;lt++)w(X.location+lt,Rt/X.locationSize,pt,it,Rt*_t,Rt/X.locationSize*lt*_t,Nt)}}else if(W!==void 0){let it=W[at];if(it!==void 0)switch(it.length){case 2:i.vertexAttrib2fv(X.location,it);break;case 3:i.vertexAttrib3fv(X.location,it);break;case 4:i.vertexAttrib4fv(X.location,it);break;default:i.vertexAttrib1fv(X.location,it)}}}}x()}function E(){F();for(let D in n){let B=n[D];for(let Z in B){let P=B[Z];for(let $ in P){let Q=P[$];for(let W in Q)h(Q[W].object),delete Q[W];delete P[$]}}delete n[D]}}function T(D){if(n[D.id]===void 0)return;let B=n[D.id];for(let Z in B){let P=B[Z];for(let $ in P){let Q=P[$];for(let W in Q)h(Q[W].object),delete Q[W];delete P[$]}}delete n[D.id]}function y(D){for(let B in n){let Z=n[B];for(let P in Z){let $=Z[P];if($[D.id]===void 0)continue;let Q=$[D.id];for(let W in Q)h(Q[W].object),delete Q[W];delete $[D.id]}}}function A(D){for(let B in n){let Z=n[B],P=D.isInstancedMesh===!0?D.id:0,$=Z[P];if($!==void 0){for(let Q in $){let W=$[Q];for(let at in W)h(W[at].object),delete W[at];delete $[Q]}delete Z[P],Object.keys(Z).length===0&&delete n[B]}}}function F(){N(),a=!0,r!==s&&(r=s,c(r.object))}function N(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:o,reset:F,resetDefaultState:N,dispose:E,releaseStatesOfGeometry:T,releaseStatesOfObject:A,releaseStatesOfProgram:y,initAttributes:_,enableAttribute:m,disableUnusedAttributes:x}}function w1(i,t,e){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),e.update(c,n,1)}function a(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),e.update(c,n,h))}function o(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let f=0;for(let d=0;d<h;d++)f+=c[d];e.update(f,n,1)}this.setMode=s,this.render=r,this.renderInstances=a,this.renderMultiDraw=o}function b1(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let y=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function a(y){return!(y!==ri&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function o(y){let A=y===_i&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(y!==kn&&y!==si&&!A&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(y){if(y==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(Ut("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),f=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Ut("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Ut("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),p=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),x=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),w=i.getParameter(i.MAX_VARYING_VECTORS),M=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),E=i.getParameter(i.MAX_SAMPLES),T=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:a,textureTypeReadable:o,precision:c,logarithmicDepthBuffer:f,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:p,maxTextureSize:_,maxCubemapSize:m,maxAttributes:g,maxVertexUniforms:x,maxVaryings:w,maxFragmentUniforms:M,maxSamples:E,samples:T}}function S1(i){let t=this,e=null,n=0,s=!1,r=!1,a=new Cn,o=new Yt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){let d=u.length!==0||f||n!==0||s;return s=f,n=u.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){e=h(u,f,0)},this.setState=function(u,f,d){let p=u.clippingPlanes,_=u.clipIntersection,m=u.clipShadows,g=i.get(u);if(!s||p===null||p.length===0||r&&!m)r?h(null):c();else{let x=r?0:n,w=x*4,M=g.clippingState||null;l.value=M,M=h(p,f,w,d);for(let E=0;E!==w;++E)M[E]=e[E];g.clippingState=M,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=x}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(u,f,d,p){let _=u!==null?u.length:0,m=null;if(_!==0){if(m=l.value,p!==!0||m===null){let g=d+_*4,x=f.matrixWorldInverse;o.getNormalMatrix(x),(m===null||m.length<g)&&(m=new Float32Array(g));for(let w=0,M=d;w!==_;++w,M+=4)a.copy(u[w]).applyMatrix4(x,o),a.normal.toArray(m,M),m[M+3]=a.constant}l.value=m,l.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,m}}var wo=class extends Yn{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new ja(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Vr(5,5,5),r=new Ai({name:"CubemapFromEquirect",uniforms:Zs(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Nn,blending:Ws});r.uniforms.tEquirect.value=e;let a=new Bn(s,r),o=e.minFilter;return e.minFilter===Yi&&(e.minFilter=In),new Wr(1,10,this).update(t,a),e.minFilter=o,a.geometry.dispose(),a.material.dispose(),this}clear(t,e=!0,n=!0,s=!0){let r=t.getRenderTarget();for(let a=0;a<6;a++)t.setRenderTarget(this,a),t.clear(e,n,s);t.setRenderTarget(r)}},Q0=256,E1=3,A1=20,w_=256,b_=16,T1=3,R1=new k,C1=new Jt,dh=class i{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Wr(1,10,null),this._boxMesh=new Bn(new Vr(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,n=.1,s=100,r={}){let{size:a=256,position:o=R1}=r,l=this._renderer;this._setSize(a);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,f=l.autoClearColor,d=l.autoClearDepth,p=l.autoClearStencil,_=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,_===null&&(t.background=l.getClearColor(C1));let m=new Wr(n,s,h);return m.position.copy(o),m.update(l,t),l.autoClear=u,l.autoClearColor=f,l.autoClearDepth=d,l.autoClearStencil=p,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=n_(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=e_(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(Q0,dd(t))}_fromTexture(t,e){t.mapping===$s||t.mapping===qr?this._setSize(t.image.length===0?Q0:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let n=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(n),n}_allocateTarget(){let t=this._cubeSize,e=t_(t,!1,!1),n=Math.log2(t)-E1;for(let s=0;s<=n;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==e||t&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=t_(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=t,r.activeMipmapLevel=e;let a=t.width>>e;t.viewport.set(0,0,a,a),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===$s||t.mapping===qr?(this._cubemapMaterial===null&&(this._cubemapMaterial=n_()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=e_()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=P1(),this._integrationMaterial=I1());let e=this._cubeSize,n=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/b_);for(let a=0;a<=n;a++){let o=i.lodToRoughness(a,n);if(a>n-T1)r.roughness.value=o,this._renderCube(t,a,this._integrationMaterial);else{let l=o>0?Math.log2(e)+.5*Math.log2(6/(w_*Math.pow(o,4)))+.5:0;s.roughness.value=o,s.lodBias.value=l,this._renderCube(t,a,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=L1());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,n),s.envMap.value=t.texture,this._renderCube(r,0,n)}};function t_(i,t,e){return new wo(i,{minFilter:Yi,generateMipmaps:t,type:_i,colorSpace:za,depthBuffer:e})}function bo(i,t,e){return new Ai({name:i,uniforms:t,vertexShader:te.cube_vert,fragmentShader:e,side:Nn,blending:Ws,depthTest:!1,depthWrite:!1})}function P1(){return bo("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${w_}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function I1(){return bo("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:b_}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function L1(){return bo("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${A1}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function e_(){return bo("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function n_(){return bo("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function N1(i){let t=new WeakMap,e=new WeakMap,n=null;function s(f,d=!1){return f==null?null:d?a(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===Ec||d===Ac)if(t.has(f)){let p=t.get(f).texture;return o(p,f.mapping)}else{let p=f.image;if(p&&p.height>0){let _=new wo(p.height);return _.fromEquirectangularTexture(i,f),t.set(f,_),f.addEventListener("dispose",c),o(_.texture,f.mapping)}else return null}}return f}function a(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,p=d===Ec||d===Ac,_=d===$s||d===qr;if(p||_){let m=e.get(f),g=m!==void 0?m.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==g)return n===null&&(n=new dh(i)),m=p?n.fromEquirectangular(f,m):n.fromCubemap(f,m),m.texture.pmremVersion=f.pmremVersion,e.set(f,m),m.texture;if(m!==void 0)return m.texture;{let x=f.image;return p&&x&&x.height>0||_&&x&&l(x)?(n===null&&(n=new dh(i)),m=p?n.fromEquirectangular(f):n.fromCubemap(f),m.texture.pmremVersion=f.pmremVersion,e.set(f,m),f.addEventListener("dispose",h),m.texture):null}}}return f}function o(f,d){return d===Ec?f.mapping=$s:d===Ac&&(f.mapping=qr),f}function l(f){let d=0,p=6;for(let _=0;_<p;_++)f[_]!==void 0&&d++;return d===p}function c(f){let d=f.target;d.removeEventListener("dispose",c);let p=t.get(d);p!==void 0&&(t.delete(d),p.dispose())}function h(f){let d=f.target;d.removeEventListener("dispose",h);let p=e.get(d);p!==void 0&&(e.delete(d),p.dispose())}function u(){t=new WeakMap,e=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function D1(i){let t={};function e(n){if(t[n]!==void 0)return t[n];let s=i.getExtension(n);return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let s=e(n);return s===null&&Ua("WebGLRenderer: "+n+" extension not supported."),s}}}function O1(i,t,e,n){let s={},r=new WeakMap,a=new FinalizationRegistry(p=>delete s[p]);function o(p){l(p.target)}function l(p){p.index!==null&&t.remove(p.index);for(let m in p.attributes)t.remove(p.attributes[m]);p.removeEventListener("dispose",o),delete s[p.id],a.unregister(p);let _=r.get(p);_&&(t.remove(_),r.delete(p)),n.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,e.memory.geometries--}function c(p,_){return s[_.id]!==void 0||(_.addEventListener("dispose",o),s[_.id]=new WeakRef(_),a.register(_,_.id,_),e.memory.geometries++),_}function h(p){let _=p.attributes;for(let m in _)t.update(_[m],i.ARRAY_BUFFER)}function u(p){let _=p.index,m=p.attributes.position,g=0;if(m===void 0)return;let x=_!==null?_.array.length:m.array.length/3-1,w=m.count>=65535?qa:$a,M=new w(Math.ceil(x/3)*6,1),E=M.array;if(_!==null){let y=_.array;g=_.version;for(let A=0,F=0;A<x;A+=3){let N=y[A+0],D=y[A+1],B=y[A+2];E[F++]=N,E[F++]=D,E[F++]=D,E[F++]=B,E[F++]=B,E[F++]=N}}else{g=m.version;for(let y=0,A=0;y<x;y+=3){let F=y+0,N=y+1,D=y+2;E[A++]=F,E[A++]=N,E[A++]=N,E[A++]=D,E[A++]=D,E[A++]=F}}M.version=g;let T=r.get(p);T&&t.remove(T),r.set(p,M)}function f(p){let _=r.get(p);if(_){let m=p.index;m!==null&&_.version<m.version&&u(p)}else u(p);return r.get(p)}function d(){for(let p in s){let _=s[p].deref();_!==void 0&&l(_)}}return{get:c,update:h,getWireframeAttribute:f,dispose:d}}function U1(i,t,e){let n;function s(u){n=u}let r,a;function o(u){r=u.type,a=u.bytesPerElement}function l(u,f){i.drawElements(n,f,r,u*a),e.update(f,n,1)}function c(u,f,d){d!==0&&(i.drawElementsInstanced(n,f,r,u*a,d),e.update(f,n,d))}function h(u,f,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,f,0,r,u,0,d);let _=0;for(let m=0;m<d;m++)_+=f[m];e.update(_,n,1)}this.setMode=s,this.setIndex=o,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function F1(i){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,a,o){switch(e.calls++,a){case i.TRIANGLES:e.triangles+=o*(r/3);break;case i.LINES:e.lines+=o*(r/2);break;case i.LINE_STRIP:e.lines+=o*(r-1);break;case i.LINE_LOOP:e.lines+=o*r;break;case i.POINTS:e.points+=o*r;break;default:Wt("WebGLInfo: Unknown draw mode:",a);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function B1(i,t,e){let n=new WeakMap,s=new Se;function r(a,o,l){let c=a.morphTargetInfluences,h=o.morphAttributes.position||o.morphAttributes.normal||o.morphAttributes.color,u=h!==void 0?h.length:0,f=n.get(o);if(f===void 0||f.count!==u){let F=function(){y.dispose(),n.delete(o),o.removeEventListener("dispose",F)};f!==void 0&&f.texture.dispose();let d=o.morphAttributes.position!==void 0,p=o.morphAttributes.normal!==void 0,_=o.morphAttributes.color!==void 0,m=o.morphAttributes.position||[],g=o.morphAttributes.normal||[],x=o.morphAttributes.color||[],w=0;d===!0&&(w=1),p===!0&&(w=2),_===!0&&(w=3);let M=o.attributes.position.count*w,E=1;M>t.maxTextureSize&&(E=Math.ceil(M/t.maxTextureSize),M=t.maxTextureSize);let T=new Float32Array(M*E*4*u),y=new Ha(T,M,E,u);y.type=si,y.needsUpdate=!0;let A=w*4;for(let N=0;N<u;N++){let D=m[N],B=g[N],Z=x[N],P=M*E*4*N;for(let $=0;$<D.count;$++){let Q=$*A;d===!0&&(s.fromBufferAttribute(D,$),T[P+Q+0]=s.x,T[P+Q+1]=s.y,T[P+Q+2]=s.z,T[P+Q+3]=0),p===!0&&(s.fromBufferAttribute(B,$),T[P+Q+4]=s.x,T[P+Q+5]=s.y,T[P+Q+6]=s.z,T[P+Q+7]=0),_===!0&&(s.fromBufferAttribute(Z,$),T[P+Q+8]=s.x,T[P+Q+9]=s.y,T[P+Q+10]=s.z,T[P+Q+11]=Z.itemSize===4?s.w:1)}}f={count:u,texture:y,size:new zt(M,E)},n.set(o,f),o.addEventListener("dispose",F)}if(a.isInstancedMesh===!0&&a.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",a.morphTexture,e);else{let d=0;for(let _=0;_<c.length;_++)d+=c[_];let p=o.morphTargetsRelative?1:1-d;l.getUniforms().setValue(i,"morphTargetBaseInfluence",p),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",f.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",f.size)}return{update:r}}function k1(i,t,e,n,s){let r=new WeakMap;function a(c){let h=s.render.frame,u=c.geometry,f=t.get(c,u);if(r.get(f)!==h&&(t.update(f),r.set(f,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let d=c.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return f}function o(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:a,dispose:o}}var z1={[$f]:"LINEAR_TONE_MAPPING",[qf]:"REINHARD_TONE_MAPPING",[Yf]:"CINEON_TONE_MAPPING",[Zf]:"ACES_FILMIC_TONE_MAPPING",[Kf]:"AGX_TONE_MAPPING",[jf]:"NEUTRAL_TONE_MAPPING",[Jf]:"CUSTOM_TONE_MAPPING"};function G1(i,t,e,n,s,r){let a=new Yn(t,e,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),o=null,l=null,c=null,h=new Ln;h.setAttribute("position",new dn([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new dn([0,2,0,0,2,0],2));let u=new cc({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),f=new Bn(h,u),d=new oo(-1,1,1,-1,0,1),p=null,_=null,m=!1,g,x=null,w=[],M=!1;this.setSize=function(E,T){a.setSize(E,T),o!==null&&o.setSize(E,T),l!==null&&l.setSize(E,T);for(let y=0;y<w.length;y++){let A=w[y];A.setSize&&A.setSize(E,T)}},this.setEffects=function(E){w=E,M=w.length>0&&w[0].isRenderPass===!0;let T=a.width,y=a.height;w.length>0&&o===null&&(o=new Yn(T,y,{type:_i,depthBuffer:!1,stencilBuffer:!1}),l=new Yn(T,y,{type:_i,depthBuffer:!1,stencilBuffer:!1}));let A=s===!0&&w.some(F=>F.needsDepthTexture===!0);A!==(a.depthTexture!==null)&&(A===!0&&c===null&&(c=new qi(T,y),r===!0&&(c.format=Zi,c.type=qs)),a.dispose(),a.depthTexture=A?c:null,a.resolveDepthBuffer=A,a.storeMultisampledDepthBuffer=A);for(let F=0;F<w.length;F++){let N=w[F];N.setSize&&N.setSize(T,y),A&&N.needsDepthTexture===!0&&N.setDepthTexture&&N.setDepthTexture(c)}},this.begin=function(E,T){if(m||E.toneMapping===Ri&&w.length===0)return!1;if(x=T,T!==null){let y=T.width,A=T.height;(a.width!==y||a.height!==A)&&this.setSize(y,A)}return M===!1&&E.setRenderTarget(a),g=E.toneMapping,E.toneMapping=Ri,!0},this.hasRenderPass=function(){return M},this.end=function(E,T){E.toneMapping=g,m=!0;let y=a,A=o;for(let F=0;F<w.length;F++){let N=w[F];N.enabled!==!1&&(N.render(E,A,y,T),N.needsSwap!==!1&&(y=A,A=A===o?l:o))}if(p!==E.outputColorSpace||_!==E.toneMapping){p=E.outputColorSpace,_=E.toneMapping,u.defines={},he.getTransfer(p)===we&&(u.defines.SRGB_TRANSFER="");let F=z1[_];F&&(u.defines[F]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=y.texture,E.setRenderTarget(x),E.render(f,d),x=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){a.dispose(),o!==null&&o.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var S_=new Fn,E_=new qi(1,1),A_=new Qa(1),T_=new Ha,R_=new rc,C_=new ja,i_=[],s_=[],r_=new Float32Array(16),a_=new Float32Array(9),o_=new Float32Array(4);function Jr(i,t,e){let n=i[0];if(n<=0||n>0)return i;let s=t*e,r=i_[s];if(r===void 0&&(r=new Float32Array(s),i_[s]=r),t!==0){n.toArray(r,0);for(let a=1,o=0;a!==t;++a)o+=e,i[a].toArray(r,o)}return r}function tn(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function en(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function mh(i,t){let e=s_[t];e===void 0&&(e=new Int32Array(t),s_[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function V1(i,t){let e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function H1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(tn(e,t))return;i.uniform2fv(this.addr,t),en(e,t)}}function W1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(tn(e,t))return;i.uniform3fv(this.addr,t),en(e,t)}}function X1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(tn(e,t))return;i.uniform4fv(this.addr,t),en(e,t)}}function $1(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(tn(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),en(e,t)}else{if(tn(e,n))return;o_.set(n),i.uniformMatrix2fv(this.addr,!1,o_),en(e,n)}}function q1(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(tn(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),en(e,t)}else{if(tn(e,n))return;a_.set(n),i.uniformMatrix3fv(this.addr,!1,a_),en(e,n)}}function Y1(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(tn(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),en(e,t)}else{if(tn(e,n))return;r_.set(n),i.uniformMatrix4fv(this.addr,!1,r_),en(e,n)}}function Z1(i,t){let e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function J1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(tn(e,t))return;i.uniform2iv(this.addr,t),en(e,t)}}function K1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(tn(e,t))return;i.uniform3iv(this.addr,t),en(e,t)}}function j1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(tn(e,t))return;i.uniform4iv(this.addr,t),en(e,t)}}function Q1(i,t){let e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function tE(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(tn(e,t))return;i.uniform2uiv(this.addr,t),en(e,t)}}function eE(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(tn(e,t))return;i.uniform3uiv(this.addr,t),en(e,t)}}function nE(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(tn(e,t))return;i.uniform4uiv(this.addr,t),en(e,t)}}function gh(i){return i.version===0&&(i.compareFunction=cd,i.needsUpdate=!0),i}function iE(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=gh(E_):r=S_,e.setTexture2D(t||r,s)}function sE(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||R_,s)}function rE(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=gh(A_):r=C_,e.setTextureCube(t||r,s)}function aE(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||T_,s)}function oE(i){switch(i){case 5126:return V1;case 35664:return H1;case 35665:return W1;case 35666:return X1;case 35674:return $1;case 35675:return q1;case 35676:return Y1;case 5124:case 35670:return Z1;case 35667:case 35671:return J1;case 35668:case 35672:return K1;case 35669:case 35673:return j1;case 5125:return Q1;case 36294:return tE;case 36295:return eE;case 36296:return nE;case 35678:case 36198:case 36298:case 36306:case 35682:return iE;case 35679:case 36299:case 36307:return sE;case 35680:case 36300:case 36308:case 36293:return rE;case 36289:case 36303:case 36311:case 36292:return aE}}function lE(i,t){i.uniform1fv(this.addr,t)}function cE(i,t){let e=Jr(t,this.size,2);i.uniform2fv(this.addr,e)}function hE(i,t){let e=Jr(t,this.size,3);i.uniform3fv(this.addr,e)}function uE(i,t){let e=Jr(t,this.size,4);i.uniform4fv(this.addr,e)}function fE(i,t){let e=Jr(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function dE(i,t){let e=Jr(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function pE(i,t){let e=Jr(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function mE(i,t){i.uniform1iv(this.addr,t)}function gE(i,t){i.uniform2iv(this.addr,t)}function _E(i,t){i.uniform3iv(this.addr,t)}function yE(i,t){i.uniform4iv(this.addr,t)}function xE(i,t){i.uniform1uiv(this.addr,t)}function vE(i,t){i.uniform2uiv(this.addr,t)}function ME(i,t){i.uniform3uiv(this.addr,t)}function wE(i,t){i.uniform4uiv(this.addr,t)}function bE(i,t,e){let n=this.cache,s=t.length,r=mh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));let a;this.type===i.SAMPLER_2D_SHADOW?a=gh(E_):a=S_;for(let o=0;o!==s;++o)e.setTexture2D(t[o]||a,r[o])}function SE(i,t,e){let n=this.cache,s=t.length,r=mh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));for(let a=0;a!==s;++a)e.setTexture3D(t[a]||R_,r[a])}function EE(i,t,e){let n=this.cache,s=t.length,r=mh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));let a;this.type===i.SAMPLER_CUBE_SHADOW?a=gh(A_):a=C_;for(let o=0;o!==s;++o)e.setTextureCube(t[o]||a,r[o])}function AE(i,t,e){let n=this.cache,s=t.length,r=mh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));for(let a=0;a!==s;++a)e.setTexture2DArray(t[a]||T_,r[a])}function TE(i){switch(i){case 5126:return lE;case 35664:return cE;case 35665:return hE;case 35666:return uE;case 35674:return fE;case 35675:return dE;case 35676:return pE;case 5124:case 35670:return mE;case 35667:case 35671:return gE;case 35668:case 35672:return _E;case 35669:case 35673:return yE;case 5125:return xE;case 36294:return vE;case 36295:return ME;case 36296:return wE;case 35678:case 36198:case 36298:case 36306:case 35682:return bE;case 35679:case 36299:case 36307:return SE;case 35680:case 36300:case 36308:case 36293:return EE;case 36289:case 36303:case 36311:case 36292:return AE}}var wd=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=oE(e.type)}},bd=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=TE(e.type)}},Sd=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let s=this.seq;for(let r=0,a=s.length;r!==a;++r){let o=s[r];o.setValue(t,e[o.id],n)}}},vd=/(\w+)(\])?(\[|\.)?/g;function l_(i,t){i.seq.push(t),i.map[t.id]=t}function RE(i,t,e){let n=i.name,s=n.length;for(vd.lastIndex=0;;){let r=vd.exec(n),a=vd.lastIndex,o=r[1],l=r[2]==="]",c=r[3];if(l&&(o=o|0),c===void 0||c==="["&&a+2===s){l_(e,c===void 0?new wd(o,i,t):new bd(o,i,t));break}else{let u=e.map[o];u===void 0&&(u=new Sd(o),l_(e,u)),e=u}}}var Zr=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let a=0;a<n;++a){let o=t.getActiveUniform(e,a),l=t.getUniformLocation(e,o.name);RE(o,l,this)}let s=[],r=[];for(let a of this.seq)a.type===t.SAMPLER_2D_SHADOW||a.type===t.SAMPLER_CUBE_SHADOW||a.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(a):r.push(a);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,n,s){let r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){let s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,a=e.length;r!==a;++r){let o=e[r],l=n[o.id];l.needsUpdate!==!1&&o.setValue(t,l.value,s)}}static seqWithValue(t,e){let n=[];for(let s=0,r=t.length;s!==r;++s){let a=t[s];a.id in e&&n.push(a)}return n}};function c_(i,t,e){let n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}var CE=37297,PE=0;function IE(i,t){let e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let a=s;a<r;a++){let o=a+1;n.push(`${o===t?">":" "} ${o}: ${e[a]}`)}return n.join(`
`)}var h_=new Yt;function LE(i){he._getMatrix(h_,he.workingColorSpace,i);let t=`mat3( ${h_.elements.map(e=>e.toFixed(4))} )`;switch(he.getTransfer(i)){case Ga:return[t,"LinearTransferOETF"];case we:return[t,"sRGBTransferOETF"];default:return Ut("WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function u_(i,t,e){let n=i.getShaderParameter(t,i.COMPILE_STATUS),r=(i.getShaderInfoLog(t)||"").trim();if(n&&r==="")return"";let a=/ERROR: 0:(\d+)/.exec(r);if(a){let o=parseInt(a[1]);return e.toUpperCase()+`

`+r+`

`+IE(i.getShaderSource(t),o)}else return r}function NE(i,t){let e=LE(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var DE={[$f]:"Linear",[qf]:"Reinhard",[Yf]:"Cineon",[Zf]:"ACESFilmic",[Kf]:"AgX",[jf]:"Neutral",[Jf]:"Custom"};function OE(i,t){let e=DE[t];return e===void 0?(Ut("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var fh=new k;function UE(){he.getLuminanceCoefficients(fh);let i=fh.x.toFixed(4),t=fh.y.toFixed(4),e=fh.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function FE(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Mo).join(`
`)}function BE(i){let t=[];for(let e in i){let n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function kE(i,t){let e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(t,s),a=r.name,o=1;r.type===i.FLOAT_MAT2&&(o=2),r.type===i.FLOAT_MAT3&&(o=3),r.type===i.FLOAT_MAT4&&(o=4),e[a]={type:r.type,location:i.getAttribLocation(t,a),locationSize:o}}return e}function Mo(i){return i!==""}function f_(i,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function d_(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var zE=/^[ \t]*#include +<([\w\d./]+)>/gm;function Ed(i){return i.replace(zE,GE)}function GE(i,t){let e=te[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Ed(e)}var VE=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function p_(i){return i.replace(VE,HE)}function HE(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function m_(i){let t=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?t+=`
#define HIGH_PRECISION`:i.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var WE={[Hs]:"SHADOWMAP_TYPE_PCF",[Xr]:"SHADOWMAP_TYPE_VSM"};function XE(i){return WE[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var $E={[qr]:"ENVMAP_MODE_REFRACTION"};function qE(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":$E[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var YE={[Sc]:"ENVMAP_BLENDING_MULTIPLY",[P0]:"ENVMAP_BLENDING_MIX",[I0]:"ENVMAP_BLENDING_ADD"};function ZE(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":YE[i.combine]||"ENVMAP_BLENDING_NONE"}function JE(i,t,e,n){let s=i.getContext(),r=e.defines,a=e.vertexShader,o=e.fragmentShader,l=XE(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=qE(e),u=ZE(e),f=FE(e),d=BE(r),p=s.createProgram(),_,m,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(Mo).join(`
`),_.length>0&&(_+=`
`),m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(Mo).join(`
`),m.length>0&&(m+=`
`)):(_=[m_(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Mo).join(`
`),m=[m_(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Ri?"#define TONE_MAPPING":"",e.toneMapping!==Ri?te.tonemapping_pars_fragment:"",e.toneMapping!==Ri?OE("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",te.colorspace_pars_fragment,NE("linearToOutputTexel",e.outputColorSpace),UE(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(Mo).join(`
`)),a=Ed(a),a=f_(a,e),a=d_(a,e),o=Ed(o),o=f_(o,e),o=d_(o,e),a=p_(a),o=p_(o),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,_=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,m=["#define varying in",e.glslVersion===hd?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===hd?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let x=g+_+a,w=g+m+o,M=c_(s,s.VERTEX_SHADER,x),E=c_(s,s.FRAGMENT_SHADER,w);s.attachShader(p,M),s.attachShader(p,E),e.index0AttributeName!==void 0?s.bindAttribLocation(p,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function T(N){if(i.debug.checkShaderErrors){let D=s.getProgramInfoLog(p)||"",B=s.getShaderInfoLog(M)||"",Z=s.getShaderInfoLog(E)||"",P=D.trim(),$=B.trim(),Q=Z.trim(),W=!0,at=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(W=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,p,M,E);else{let X=u_(s,M,"vertex"),z=u_(s,E,"fragment");Wt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+N.name+`
Material Type: `+N.type+`

Program Info Log: `+P+`
`+X+`
`+z)}else P!==""?Ut("WebGLProgram: Program Info Log:",P):($===""||Q==="")&&(at=!1);at&&(N.diagnostics={runnable:W,programLog:P,vertexShader:{log:$,prefix:_},fragmentShader:{log:Q,prefix:m}})}s.deleteShader(M),s.deleteShader(E),y=new Zr(s,p),A=kE(s,p)}let y;this.getUniforms=function(){return y===void 0&&T(this),y};let A;this.getAttributes=function(){return A===void 0&&T(this),A};let F=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return F===!1&&(F=s.getProgramParameter(p,CE)),F},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=PE++,this.cacheKey=t,this.usedTimes=1,this.program=p,this.vertexShader=M,this.fragmentShader=E,this}var KE=0,Ad=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,n){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new Td(t),e.set(t,n)),n}},Td=class{constructor(t){this.id=KE++,this.code=t,this.usedTimes=0}};function jE(i){return i===ys||i===yo||i===xo}function QE(i,t,e,n,s,r){let a=new Fr,o=new Ad,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(y){return l.add(y),y===0?"uv":`uv${y}`}function p(y,A,F,N,D,B){let Z=N.fog,P=D.geometry,$=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?N.environment:null,Q=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap,W=t.get(y.envMap||$,Q),at=f[y.type],X=n.precision;y.precision!==null&&(X=n.getMaxPrecision(y.precision),X!==y.precision&&Ut("WebGLProgram.getParameters:",y.precision,"not supported, using",X,"instead."));let z=P.morphAttributes.position||P.morphAttributes.normal||P.morphAttributes.color,it=z!==void 0?z.length:0,Rt=0;P.morphAttributes.position!==void 0&&(Rt=1),P.morphAttributes.normal!==void 0&&(Rt=2),P.morphAttributes.color!==void 0&&(Rt=3);let kt,et,pt,_t;if(at){let wt=Pi[at];kt=wt.vertexShader,et=wt.fragmentShader}else{kt=y.vertexShader,et=y.fragmentShader;let wt=o.getVertexShaderStage(y),me=o.getFragmentShaderStage(y);o.update(y,wt,me),pt=wt.id,_t=me.id}let Nt=i.getRenderTarget(),lt=i.state.buffers.depth.getReversed(),Tt=D.isInstancedMesh===!0,oe=D.isBatchedMesh===!0,Ft=!!y.map,ee=!!y.matcap,xe=!!W,Qt=xe&&W.isPMREMTexture===!0,We=!!y.aoMap,Ue=!!y.lightMap,fn=!!y.bumpMap&&y.wireframe===!1,ve=!!y.normalMap,le=!!y.displacementMap,Be=!!y.emissiveMap,bn=!!y.metalnessMap,pn=!!y.roughnessMap,ze=y.anisotropy>0,O=y.clearcoat>0,Sn=y.diffuseRoughness>0,pe=y.dispersion>0,Te=y.retroreflectivity>0,Mt=y.iridescence>0,ke=y.sheen>0,Bt=y.transmission>0,Vt=ze&&!!y.anisotropyMap,C=O&&!!y.clearcoatMap,b=O&&!!y.clearcoatNormalMap,V=O&&!!y.clearcoatRoughnessMap,ot=Sn&&!!y.diffuseRoughnessMap,st=Mt&&!!y.iridescenceMap,ut=Mt&&!!y.iridescenceThicknessMap,yt=ke&&!!y.sheenColorMap,j=ke&&!!y.sheenRoughnessMap,tt=!!y.specularMap,ft=!!y.specularColorMap,I=!!y.specularIntensityMap,nt=Bt&&!!y.transmissionMap,J=Bt&&!!y.thicknessMap,mt=!!y.gradientMap,ht=!!y.alphaMap,dt=y.alphaTest>0,Dt=!!y.alphaHash,Kt=!!y.extensions,ct=Ri;y.toneMapped&&(Nt===null||Nt.isXRRenderTarget===!0)&&(ct=i.toneMapping);let Ot=Qt?W.isCompressedCubeTexture?W.image[0].mipmaps:W.mipmaps:null,Zt={shaderID:at,shaderType:y.type,shaderName:y.name,vertexShader:kt,fragmentShader:et,defines:y.defines,customVertexShaderID:pt,customFragmentShaderID:_t,isRawShaderMaterial:y.isRawShaderMaterial===!0,glslVersion:y.glslVersion,precision:X,batching:oe,batchingColor:oe&&D._colorsTexture!==null,instancing:Tt,instancingColor:Tt&&D.instanceColor!==null,instancingMorph:Tt&&D.morphTexture!==null,outputColorSpace:Nt===null?i.outputColorSpace:Nt.isXRRenderTarget===!0?Nt.texture.colorSpace:he.workingColorSpace,alphaToCoverage:!!y.alphaToCoverage,map:Ft,matcap:ee,envMap:xe,envMapMode:xe&&W.mapping,envMapPMREM:Qt,envMapMaxLod:Qt?Ot.length-1:null,envMapSize:Qt?Ot[0].width:null,aoMap:We,lightMap:Ue,bumpMap:fn,normalMap:ve,displacementMap:le,emissiveMap:Be,normalMapObjectSpace:ve&&y.normalMapType===O0,normalMapTangentSpace:ve&&y.normalMapType===hh,packedNormalMap:ve&&y.normalMapType===hh&&jE(y.normalMap.format),metalnessMap:bn,roughnessMap:pn,anisotropy:ze,anisotropyMap:Vt,clearcoat:O,clearcoatMap:C,clearcoatNormalMap:b,clearcoatRoughnessMap:V,diffuseRoughness:Sn,diffuseRoughnessMap:ot,dispersion:pe,retroreflection:Te,iridescence:Mt,iridescenceMap:st,iridescenceThicknessMap:ut,sheen:ke,sheenColorMap:yt,sheenRoughnessMap:j,specularMap:tt,specularColorMap:ft,specularIntensityMap:I,transmission:Bt,transmissionMap:nt,thicknessMap:J,gradientMap:mt,opaque:y.transparent===!1&&y.blending===$r&&y.alphaToCoverage===!1,alphaMap:ht,alphaTest:dt,alphaHash:Dt,combine:y.combine,mapUv:Ft&&d(y.map.channel),aoMapUv:We&&d(y.aoMap.channel),lightMapUv:Ue&&d(y.lightMap.channel),bumpMapUv:fn&&d(y.bumpMap.channel),normalMapUv:ve&&d(y.normalMap.channel),displacementMapUv:le&&d(y.displacementMap.channel),emissiveMapUv:Be&&d(y.emissiveMap.channel),metalnessMapUv:bn&&d(y.metalnessMap.channel),roughnessMapUv:pn&&d(y.roughnessMap.channel),anisotropyMapUv:Vt&&d(y.anisotropyMap.channel),clearcoatMapUv:C&&d(y.clearcoatMap.channel),clearcoatNormalMapUv:b&&d(y.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:V&&d(y.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ot&&d(y.diffuseRoughnessMap.channel),iridescenceMapUv:st&&d(y.iridescenceMap.channel),iridescenceThicknessMapUv:ut&&d(y.iridescenceThicknessMap.channel),sheenColorMapUv:yt&&d(y.sheenColorMap.channel),sheenRoughnessMapUv:j&&d(y.sheenRoughnessMap.channel),specularMapUv:tt&&d(y.specularMap.channel),specularColorMapUv:ft&&d(y.specularColorMap.channel),specularIntensityMapUv:I&&d(y.specularIntensityMap.channel),transmissionMapUv:nt&&d(y.transmissionMap.channel),thicknessMapUv:J&&d(y.thicknessMap.channel),alphaMapUv:ht&&d(y.alphaMap.channel),vertexTangents:!!P.attributes.tangent&&(ve||ze),vertexNormals:!!P.attributes.normal,vertexColors:y.vertexColors,vertexAlphas:y.vertexColors===!0&&!!P.attributes.color&&P.attributes.color.itemSize===4,pointsUvs:D.isPoints===!0&&!!P.attributes.uv&&(Ft||ht),fog:!!Z,useFog:y.fog===!0,fogExp2:!!Z&&Z.isFogExp2,flatShading:y.wireframe===!1&&(y.flatShading===!0||P.attributes.normal===void 0&&ve===!1&&(y.isMeshLambertMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isMeshPhysicalMaterial)),sizeAttenuation:y.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:lt,skinning:D.isSkinnedMesh===!0,hasPositionAttribute:P.attributes.position!==void 0,morphTargets:P.morphAttributes.position!==void 0,morphNormals:P.morphAttributes.normal!==void 0,morphColors:P.morphAttributes.color!==void 0,morphTargetsCount:it,morphTextureStride:Rt,numSunLights:A.sun.length,numDirLights:A.directional.length,numPointLights:A.point.length,numSpotLights:A.spot.length,numSpotLightMaps:A.spotLightMap.length,numRectAreaLights:A.rectArea.length,numHemiLights:A.hemi.length,numSunLightShadows:A.sunShadowMap.length,numDirLightShadows:A.directionalShadowMap.length,numPointLightShadows:A.pointShadowMap.length,numSpotLightShadows:A.spotShadowMap.length,numSpotLightShadowsWithMaps:A.numSpotLightShadowsWithMaps,numLightProbes:A.numLightProbes,numLightProbeGrids:B.filter(wt=>wt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:y.dithering,shadowMapEnabled:i.shadowMap.enabled&&F.length>0,shadowMapType:i.shadowMap.type,toneMapping:ct,decodeVideoTexture:Ft&&y.map.isVideoTexture===!0&&he.getTransfer(y.map.colorSpace)===we,decodeVideoTextureEmissive:Be&&y.emissiveMap.isVideoTexture===!0&&he.getTransfer(y.emissiveMap.colorSpace)===we,premultipliedAlpha:y.premultipliedAlpha,doubleSided:y.side===Ti,flipSided:y.side===Nn,useDepthPacking:y.depthPacking>=0,depthPacking:y.depthPacking||0,index0AttributeName:y.index0AttributeName,extensionClipCullDistance:Kt&&y.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Kt&&y.extensions.multiDraw===!0||oe)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:y.customProgramCacheKey()};return Zt.vertexUv1s=l.has(1),Zt.vertexUv2s=l.has(2),Zt.vertexUv3s=l.has(3),l.clear(),Zt}function _(y){let A=[];if(y.shaderID?A.push(y.shaderID):(A.push(y.customVertexShaderID),A.push(y.customFragmentShaderID)),y.defines!==void 0)for(let F in y.defines)A.push(F),A.push(y.defines[F]);return y.isRawShaderMaterial===!1&&(m(A,y),g(A,y),A.push(i.outputColorSpace)),A.push(y.customProgramCacheKey),A.join()}function m(y,A){y.push(A.precision),y.push(A.outputColorSpace),y.push(A.envMapMode),y.push(A.envMapPMREM),y.push(A.envMapMaxLod),y.push(A.envMapSize),y.push(A.mapUv),y.push(A.alphaMapUv),y.push(A.lightMapUv),y.push(A.aoMapUv),y.push(A.bumpMapUv),y.push(A.normalMapUv),y.push(A.displacementMapUv),y.push(A.emissiveMapUv),y.push(A.metalnessMapUv),y.push(A.roughnessMapUv),y.push(A.anisotropyMapUv),y.push(A.clearcoatMapUv),y.push(A.clearcoatNormalMapUv),y.push(A.clearcoatRoughnessMapUv),y.push(A.diffuseRoughnessMapUv),y.push(A.iridescenceMapUv),y.push(A.iridescenceThicknessMapUv),y.push(A.sheenColorMapUv),y.push(A.sheenRoughnessMapUv),y.push(A.specularMapUv),y.push(A.specularColorMapUv),y.push(A.specularIntensityMapUv),y.push(A.transmissionMapUv),y.push(A.thicknessMapUv),y.push(A.combine),y.push(A.fogExp2),y.push(A.sizeAttenuation),y.push(A.morphTargetsCount),y.push(A.numSunLights),y.push(A.numDirLights),y.push(A.numPointLights),y.push(A.numSpotLights),y.push(A.numSpotLightMaps),y.push(A.numHemiLights),y.push(A.numRectAreaLights),y.push(A.numSunLightShadows),y.push(A.numDirLightShadows),y.push(A.numPointLightShadows),y.push(A.numSpotLightShadows),y.push(A.numSpotLightShadowsWithMaps),y.push(A.numLightProbes),y.push(A.numLightProbeGrids),y.push(A.shadowMapType),y.push(A.toneMapping),y.push(A.numClippingPlanes),y.push(A.numClipIntersection),y.push(A.depthPacking)}function g(y,A){a.disableAll(),A.instancing&&a.enable(0),A.instancingColor&&a.enable(1),A.instancingMorph&&a.enable(2),A.matcap&&a.enable(3),A.envMap&&a.enable(4),A.normalMapObjectSpace&&a.enable(5),A.normalMapTangentSpace&&a.enable(6),A.clearcoat&&a.enable(7),A.iridescence&&a.enable(8),A.alphaTest&&a.enable(9),A.vertexColors&&a.enable(10),A.vertexAlphas&&a.enable(11),A.vertexUv1s&&a.enable(12),A.vertexUv2s&&a.enable(13),A.vertexUv3s&&a.enable(14),A.vertexTangents&&a.enable(15),A.anisotropy&&a.enable(16),A.alphaHash&&a.enable(17),A.batching&&a.enable(18),A.dispersion&&a.enable(19),A.retroreflection&&a.enable(24),A.diffuseRoughness&&a.enable(25),A.batchingColor&&a.enable(20),A.gradientMap&&a.enable(21),A.packedNormalMap&&a.enable(22),A.vertexNormals&&a.enable(23),y.push(a.mask),a.disableAll(),A.fog&&a.enable(0),A.useFog&&a.enable(1),A.flatShading&&a.enable(2),A.logarithmicDepthBuffer&&a.enable(3),A.reversedDepthBuffer&&a.enable(4),A.skinning&&a.enable(5),A.morphTargets&&a.enable(6),A.morphNormals&&a.enable(7),A.morphColors&&a.enable(8),A.premultipliedAlpha&&a.enable(9),A.shadowMapEnabled&&a.enable(10),A.doubleSided&&a.enable(11),A.flipSided&&a.enable(12),A.useDepthPacking&&a.enable(13),A.dithering&&a.enable(14),A.transmission&&a.enable(15),A.sheen&&a.enable(16),A.opaque&&a.enable(17),A.pointsUvs&&a.enable(18),A.decodeVideoTexture&&a.enable(19),A.decodeVideoTextureEmissive&&a.enable(20),A.alphaToCoverage&&a.enable(21),A.numLightProbeGrids>0&&a.enable(22),A.hasPositionAttribute&&a.enable(23),y.push(a.mask)}function x(y){let A=f[y.type],F;if(A){let N=Pi[A];F=J0.clone(N.uniforms)}else F=y.uniforms;return F}function w(y,A){let F=h.get(A);return F!==void 0?++F.usedTimes:(F=new JE(i,A,y,s),c.push(F),h.set(A,F)),F}function M(y){if(--y.usedTimes===0){let A=c.indexOf(y);c[A]=c[c.length-1],c.pop(),h.delete(y.cacheKey),y.destroy()}}function E(y){o.remove(y)}function T(){o.dispose()}return{getParameters:p,getProgramCacheKey:_,getUniforms:x,acquireProgram:w,releaseProgram:M,releaseShaderCache:E,programs:c,dispose:T}}function tA(){let i=new WeakMap;function t(a){return i.has(a)}function e(a){let o=i.get(a);return o===void 0&&(o={},i.set(a,o)),o}function n(a){i.delete(a)}function s(a,o,l){i.get(a)[o]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function eA(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.materialVariant!==t.materialVariant?i.materialVariant-t.materialVariant:i.z!==t.z?i.z-t.z:i.id-t.id}function g_(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function __(){let i=[],t=0,e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function a(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function o(f,d,p,_,m,g){let x=i[t];return x===void 0?(x={id:f.id,object:f,geometry:d,material:p,materialVariant:a(f),groupOrder:_,renderOrder:f.renderOrder,z:m,group:g},i[t]=x):(x.id=f.id,x.object=f,x.geometry=d,x.material=p,x.materialVariant=a(f),x.groupOrder=_,x.renderOrder=f.renderOrder,x.z=m,x.group=g),t++,x}function l(f,d,p,_,m,g,x){x.reversedDepth===!0&&(m=-m);let w=o(f,d,p,_,m,g);p.transmission>0?n.push(w):p.transparent===!0?s.push(w):e.push(w)}function c(f,d,p,_,m,g){let x=o(f,d,p,_,m,g);p.transmission>0?n.unshift(x):p.transparent===!0?s.unshift(x):e.unshift(x)}function h(f,d){e.length>1&&e.sort(f||eA),n.length>1&&n.sort(d||g_),s.length>1&&s.sort(d||g_)}function u(){for(let f=t,d=i.length;f<d;f++){let p=i[f];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function nA(){let i=new WeakMap;function t(n,s){let r=i.get(n),a;return r===void 0?(a=new __,i.set(n,[a])):s>=r.length?(a=new __,r.push(a)):a=r[s],a}function e(){i=new WeakMap}return{get:t,dispose:e}}function iA(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new k,color:new Jt};break;case"SpotLight":e={position:new k,direction:new k,color:new Jt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new k,color:new Jt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new k,skyColor:new Jt,groundColor:new Jt};break;case"RectAreaLight":e={color:new Jt,position:new k,halfWidth:new k,halfHeight:new k};break}return i[t.id]=e,e}}}function sA(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new zt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new zt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new zt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}var rA=0;function aA(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function oA(i){let t=new iA,e=sA(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new k);let s=new k,r=new re,a=new re;function o(c){let h=0,u=0,f=0;for(let B=0;B<9;B++)n.probe[B].set(0,0,0);let d=0,p=0,_=0,m=0,g=0,x=0,w=0,M=0,E=0,T=0,y=0,A=0,F=0,N=0;c.sort(aA);for(let B=0,Z=c.length;B<Z;B++){let P=c[B],$=P.color,Q=P.intensity,W=P.distance,at=null;if(P.shadow&&P.shadow.map&&(P.shadow.map.texture.format===ys?at=P.shadow.map.texture:at=P.shadow.map.depthTexture||P.shadow.map.texture),P.isAmbientLight)h+=$.r*Q,u+=$.g*Q,f+=$.b*Q;else if(P.isLightProbe){for(let X=0;X<9;X++)n.probe[X].addScaledVector(P.sh.coefficients[X],Q);N++}else if(P.isSunLight){let X=t.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let z=P.shadow,it=e.get(P);it.shadowIntensity=z.intensity,it.shadowBias=z.bias,it.shadowNormalBias=z.normalBias,it.shadowRadius=z.radius,it.shadowMapSize.copy(z.mapSize).multiply(z.getFrameExtents()),n.sunShadow[p]=it,n.sunShadowMap[p]=at;let Rt=z.getViewportCount();for(let kt=0;kt<Rt;kt++)n.sunShadowMatrix[_+kt]=z.getMatrix(kt),n.sunShadowCascade[_+kt]=z._cascadeData[kt];_+=Rt,p++}n.sun[d]=X,d++}else if(P.isDirectionalLight){let X=t.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let z=P.shadow,it=e.get(P);it.shadowIntensity=z.intensity,it.shadowBias=z.bias,it.shadowNormalBias=z.normalBias,it.shadowRadius=z.radius,it.shadowMapSize=z.mapSize,n.directionalShadow[m]=it,n.directionalShadowMap[m]=at,n.directionalShadowMatrix[m]=P.shadow.matrix,E++}n.directional[m]=X,m++}else if(P.isSpotLight){let X=t.get(P);X.position.setFromMatrixPosition(P.matrixWorld),X.color.copy($).multiplyScalar(Q),X.distance=W,X.coneCos=Math.cos(P.angle),X.penumbraCos=Math.cos(P.angle*(1-P.penumbra)),X.decay=P.decay,n.spot[x]=X;let z=P.shadow;if(P.map&&(n.spotLightMap[A]=P.map,A++,z.updateMatrices(P),P.castShadow&&F++),n.spotLightMatrix[x]=z.matrix,P.castShadow){let it=e.get(P);it.shadowIntensity=z.intensity,it.shadowBias=z.bias,it.shadowNormalBias=z.normalBias,it.shadowRadius=z.radius,it.shadowMapSize=z.mapSize,n.spotShadow[x]=it,n.spotShadowMap[x]=at,y++}x++}else if(P.isRectAreaLight){let X=t.get(P);X.color.copy($).multiplyScalar(Q),X.halfWidth.set(P.width*.5,0,0),X.halfHeight.set(0,P.height*.5,0),n.rectArea[w]=X,w++}else if(P.isPointLight){let X=t.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),X.distance=P.distance,X.decay=P.decay,P.castShadow){let z=P.shadow,it=e.get(P);it.shadowIntensity=z.intensity,it.shadowBias=z.bias,it.shadowNormalBias=z.normalBias,it.shadowRadius=z.radius,it.shadowMapSize=z.mapSize,it.shadowCameraNear=z.camera.near,it.shadowCameraFar=z.camera.far,n.pointShadow[g]=it,n.pointShadowMap[g]=at,n.pointShadowMatrix[g]=P.shadow.matrix,T++}n.point[g]=X,g++}else if(P.isHemisphereLight){let X=t.get(P);X.skyColor.copy(P.color).multiplyScalar(Q),X.groundColor.copy(P.groundColor).multiplyScalar(Q),n.hemi[M]=X,M++}}w>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Et.LTC_FLOAT_1,n.rectAreaLTC2=Et.LTC_FLOAT_2):(n.rectAreaLTC1=Et.LTC_HALF_1,n.rectAreaLTC2=Et.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=f;let D=n.hash;(D.sunLength!==d||D.directionalLength!==m||D.pointLength!==g||D.spotLength!==x||D.rectAreaLength!==w||D.hemiLength!==M||D.numSunShadows!==p||D.numDirectionalShadows!==E||D.numPointShadows!==T||D.numSpotShadows!==y||D.numSpotMaps!==A||D.numLightProbes!==N)&&(n.sun.length=d,n.directional.length=m,n.spot.length=x,n.rectArea.length=w,n.point.length=g,n.hemi.length=M,n.sunShadow.length=p,n.sunShadowMap.length=p,n.sunShadowMatrix.length=_,n.sunShadowCascade.length=_,n.directionalShadow.length=E,n.directionalShadowMap.length=E,n.directionalShadowMatrix.length=E,n.pointShadow.length=T,n.pointShadowMap.length=T,n.pointShadowMatrix.length=T,n.spotShadow.length=y,n.spotShadowMap.length=y,n.spotLightMatrix.length=y+A-F,n.spotLightMap.length=A,n.numSpotLightShadowsWithMaps=F,n.numLightProbes=N,D.sunLength=d,D.directionalLength=m,D.pointLength=g,D.spotLength=x,D.rectAreaLength=w,D.hemiLength=M,D.numSunShadows=p,D.numDirectionalShadows=E,D.numPointShadows=T,D.numSpotShadows=y,D.numSpotMaps=A,D.numLightProbes=N,n.version=rA++)}function l(c,h){let u=0,f=0,d=0,p=0,_=0,m=0,g=h.matrixWorldInverse;for(let x=0,w=c.length;x<w;x++){let M=c[x];if(M.isSunLight){let E=n.sun[u];E.direction.setFromMatrixPosition(M.matrixWorld),E.direction.transformDirection(g),u++}else if(M.isDirectionalLight){let E=n.directional[f];E.direction.setFromMatrixPosition(M.matrixWorld),s.setFromMatrixPosition(M.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(g),f++}else if(M.isSpotLight){let E=n.spot[p];E.position.setFromMatrixPosition(M.matrixWorld),E.position.applyMatrix4(g),E.direction.setFromMatrixPosition(M.matrixWorld),s.setFromMatrixPosition(M.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(g),p++}else if(M.isRectAreaLight){let E=n.rectArea[_];E.position.setFromMatrixPosition(M.matrixWorld),E.position.applyMatrix4(g),a.identity(),r.copy(M.matrixWorld),r.premultiply(g),a.extractRotation(r),E.halfWidth.set(M.width*.5,0,0),E.halfHeight.set(0,M.height*.5,0),E.halfWidth.applyMatrix4(a),E.halfHeight.applyMatrix4(a),_++}else if(M.isPointLight){let E=n.point[d];E.position.setFromMatrixPosition(M.matrixWorld),E.position.applyMatrix4(g),d++}else if(M.isHemisphereLight){let E=n.hemi[m];E.direction.setFromMatrixPosition(M.matrixWorld),E.direction.transformDirection(g),m++}}}return{setup:o,setupView:l,state:n}}function y_(i){let t=new oA(i),e=[],n=[],s=[];function r(u){h.camera=u,e.length=0,n.length=0,s.length=0}function a(u){u.isLightProbeGrid?s.push(u):e.push(u)}function o(u){n.push(u)}function l(){t.setup(e),s.sort((u,f)=>u.priority-f.priority||u.id-f.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:a,pushShadow:o}}function lA(i){let t=new WeakMap;function e(s,r=0){let a=t.get(s),o;return a===void 0?(o=new y_(i),t.set(s,[o])):r>=a.length?(o=new y_(i),a.push(o)):o=a[r],o}function n(){t=new WeakMap}return{get:e,dispose:n}}var cA=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,hA=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,uA=[new k(1,0,0),new k(-1,0,0),new k(0,1,0),new k(0,-1,0),new k(0,0,1),new k(0,0,-1)],fA=[new k(0,-1,0),new k(0,-1,0),new k(0,0,1),new k(0,0,-1),new k(0,-1,0),new k(0,-1,0)],x_=new re,vo=new k,Md=new k;function dA(i,t,e){let n=new hs,s=new zt,r=new zt,a=new Se,o=new hc,l=new uc,c={},h=e.maxTextureSize,u={[_s]:Nn,[Nn]:_s,[Ti]:Ti},f=new Ai({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new zt},radius:{value:4}},vertexShader:cA,fragmentShader:hA}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let p=new Ln;p.setAttribute("position",new cn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new Bn(p,f),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Hs;let g=this.type;this.render=function(T,y,A){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||T.length===0)return;this.type===u0&&(Ut("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Hs);let F=i.getRenderTarget(),N=i.getActiveCubeFace(),D=i.getActiveMipmapLevel(),B=i.state;B.setBlending(Ws),B.buffers.depth.getReversed()===!0?B.buffers.color.setClear(0,0,0,0):B.buffers.color.setClear(1,1,1,1),B.buffers.depth.setTest(!0),B.setScissorTest(!1);let Z=g!==this.type;Z&&y.traverse(function(P){P.material&&(Array.isArray(P.material)?P.material.forEach($=>$.needsUpdate=!0):P.material.needsUpdate=!0)});for(let P=0,$=T.length;P<$;P++){let Q=T[P],W=Q.shadow;if(W===void 0){Ut("WebGLShadowMap:",Q,"has no shadow.");continue}if(W.autoUpdate===!1&&W.needsUpdate===!1)continue;s.copy(W.mapSize);let at=W.getFrameExtents();s.multiply(at),r.copy(W.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/at.x),s.x=r.x*at.x,W.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/at.y),s.y=r.y*at.y,W.mapSize.y=r.y));let X=i.state.buffers.depth.getReversed();if(W.camera._reversedDepth=X,W.map===null||Z===!0){if(W.map!==null&&(W.map.depthTexture!==null&&(W.map.depthTexture.dispose(),W.map.depthTexture=null),W.map.dispose()),this.type===Xr){if(Q.isPointLight){Ut("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}W.map=new Yn(s.x,s.y,{format:ys,type:_i,minFilter:In,magFilter:In,generateMipmaps:!1}),W.map.texture.name=Q.name+".shadowMap",W.map.depthTexture=new qi(s.x,s.y,si),W.map.depthTexture.name=Q.name+".shadowMapDepth",W.map.depthTexture.format=Vi,W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=hn,W.map.depthTexture.magFilter=hn}else Q.isPointLight?(W.map=new wo(s.x),W.map.depthTexture=new Qa(s.x,gi)):(W.map=new Yn(s.x,s.y),W.map.depthTexture=new qi(s.x,s.y,gi)),W.map.depthTexture.name=Q.name+".shadowMap",W.map.depthTexture.format=Vi,this.type===Hs?(W.map.depthTexture.compareFunction=X?ld:od,W.map.depthTexture.minFilter=In,W.map.depthTexture.magFilter=In):(W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=hn,W.map.depthTexture.magFilter=hn);W.camera.updateProjectionMatrix()}W.map.isWebGLCubeRenderTarget!==!0&&(W.map.width!==s.x||W.map.height!==s.y)&&W.map.setSize(s.x,s.y);let z=W.map.isWebGLCubeRenderTarget?6:W.getViewportCount();Q.isPointLight!==!0&&W.updateMatrices(Q,A);let it=(W.camera.layers.mask&4294967294)!==0?W.camera.layers:A.layers;for(let Rt=0;Rt<z;Rt++){let kt=W.getCamera(Rt);if(Q.isPointLight){let et=W.camera,pt=W.matrix,_t=Q.distance||et.far;_t!==et.far&&(et.far=_t,et.updateProjectionMatrix()),vo.setFromMatrixPosition(Q.matrixWorld),et.position.copy(vo),Md.copy(et.position),Md.add(uA[Rt]),et.up.copy(fA[Rt]),et.lookAt(Md),et.updateMatrixWorld(),pt.makeTranslation(-vo.x,-vo.y,-vo.z),x_.multiplyMatrices(et.projectionMatrix,et.matrixWorldInverse),W._frustum.setFromProjectionMatrix(x_,et.coordinateSystem,et.reversedDepth)}if(W.map.isWebGLCubeRenderTarget)i.setRenderTarget(W.map,Rt),i.clear();else{Rt===0&&(i.setRenderTarget(W.map),i.clear());let et=W.getViewport(Rt);a.set(r.x*et.x,r.y*et.y,r.x*et.z,r.y*et.w),B.viewport(a)}n=W.getFrustum(Rt),M(y,A,kt,Q,it,this.type)}W.isPointLightShadow!==!0&&this.type===Xr&&x(W,A),W.needsUpdate=!1}g=this.type,m.needsUpdate=!1,i.setRenderTarget(F,N,D)};function x(T,y){let A=t.update(_);f.defines.VSM_SAMPLES!==T.blurSamples&&(f.defines.VSM_SAMPLES=T.blurSamples,d.defines.VSM_SAMPLES=T.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),T.mapPass===null?T.mapPass=new Yn(s.x,s.y,{format:ys,type:_i}):(T.mapPass.width!==T.map.width||T.mapPass.height!==T.map.height)&&T.mapPass.setSize(T.map.width,T.map.height),f.uniforms.shadow_pass.value=T.map.depthTexture,f.uniforms.resolution.value.set(T.map.width,T.map.height),f.uniforms.radius.value=T.radius,i.setRenderTarget(T.mapPass),i.clear(),i.renderBufferDirect(y,null,A,f,_,null),d.uniforms.shadow_pass.value=T.mapPass.texture,d.uniforms.resolution.value.set(T.map.width,T.map.height),d.uniforms.radius.value=T.radius,i.setRenderTarget(T.map),i.clear(),i.renderBufferDirect(y,null,A,d,_,null)}function w(T,y,A,F){let N=null,D=A.isPointLight===!0?T.customDistanceMaterial:T.customDepthMaterial;if(D!==void 0)N=D;else if(N=A.isPointLight===!0?l:o,i.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0||y.alphaToCoverage===!0){let B=N.uuid,Z=y.uuid,P=c[B];P===void 0&&(P={},c[B]=P);let $=P[Z];$===void 0&&($=N.clone(),P[Z]=$,y.addEventListener("dispose",E)),N=$}if(N.visible=y.visible,N.wireframe=y.wireframe,F===Xr?N.side=y.shadowSide!==null?y.shadowSide:y.side:N.side=y.shadowSide!==null?y.shadowSide:u[y.side],N.alphaMap=y.alphaMap,N.alphaTest=y.alphaToCoverage===!0?.5:y.alphaTest,N.map=y.map,N.clipShadows=y.clipShadows,N.clippingPlanes=y.clippingPlanes,N.clipIntersection=y.clipIntersection,N.displacementMap=y.displacementMap,N.displacementScale=y.displacementScale,N.displacementBias=y.displacementBias,N.wireframeLinewidth=y.wireframeLinewidth,N.linewidth=y.linewidth,A.isPointLight===!0&&N.isMeshDistanceMaterial===!0){let B=i.properties.get(N);B.light=A}return N}function M(T,y,A,F,N,D){if(T.visible===!1)return;if(T.layers.test(N)&&(T.isMesh||T.isLine||T.isPoints)&&(T.castShadow||T.receiveShadow&&D===Xr)&&(!T.frustumCulled||T.intersectsFrustum(n))){T.modelViewMatrix.multiplyMatrices(A.matrixWorldInverse,T.matrixWorld);let P=t.update(T),$=T.material;if(Array.isArray($)){let Q=P.groups;for(let W=0,at=Q.length;W<at;W++){let X=Q[W],z=$[X.materialIndex];if(z&&z.visible){let it=w(T,z,F,D);T.onBeforeShadow(i,T,y,A,P,it,X),i.renderBufferDirect(A,null,P,it,T,X),T.onAfterShadow(i,T,y,A,P,it,X)}}}else if($.visible){let Q=w(T,$,F,D);T.onBeforeShadow(i,T,y,A,P,Q,null),i.renderBufferDirect(A,null,P,Q,T,null),T.onAfterShadow(i,T,y,A,P,Q,null)}}let Z=T.children;for(let P=0,$=Z.length;P<$;P++)M(Z[P],y,A,F,N,D)}function E(T){T.target.removeEventListener("dispose",E);for(let A in c){let F=c[A],N=T.target.uuid;N in F&&(F[N].dispose(),delete F[N])}}}function pA(i,t){function e(){let I=!1,nt=new Se,J=null,mt=new Se(0,0,0,0);return{setMask:function(ht){J!==ht&&!I&&(i.colorMask(ht,ht,ht,ht),J=ht)},setLocked:function(ht){I=ht},setClear:function(ht,dt,Dt,Kt,ct){ct===!0&&(ht*=Kt,dt*=Kt,Dt*=Kt),nt.set(ht,dt,Dt,Kt),mt.equals(nt)===!1&&(i.clearColor(ht,dt,Dt,Kt),mt.copy(nt))},reset:function(){I=!1,J=null,mt.set(-1,0,0,0)}}}function n(){let I=!1,nt=!1,J=null,mt=null,ht=null;return{setReversed:function(dt){if(nt!==dt){let Dt=t.get("EXT_clip_control");dt?Dt.clipControlEXT(Dt.LOWER_LEFT_EXT,Dt.ZERO_TO_ONE_EXT):Dt.clipControlEXT(Dt.LOWER_LEFT_EXT,Dt.NEGATIVE_ONE_TO_ONE_EXT),nt=dt;let Kt=ht;ht=null,this.setClear(Kt)}},getReversed:function(){return nt},setTest:function(dt){dt?lt(i.DEPTH_TEST):Tt(i.DEPTH_TEST)},setMask:function(dt){J!==dt&&!I&&(i.depthMask(dt),J=dt)},setFunc:function(dt){if(nt&&(dt=$0[dt]),mt!==dt){switch(dt){case ql:i.depthFunc(i.NEVER);break;case Yl:i.depthFunc(i.ALWAYS);break;case Zl:i.depthFunc(i.LESS);break;case Lr:i.depthFunc(i.LEQUAL);break;case Jl:i.depthFunc(i.EQUAL);break;case Kl:i.depthFunc(i.GEQUAL);break;case jl:i.depthFunc(i.GREATER);break;case Ql:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}mt=dt}},setLocked:function(dt){I=dt},setClear:function(dt){ht!==dt&&(ht=dt,nt&&(dt=1-dt),i.clearDepth(dt))},reset:function(){I=!1,J=null,mt=null,ht=null,nt=!1}}}function s(){let I=!1,nt=null,J=null,mt=null,ht=null,dt=null,Dt=null,Kt=null,ct=null;return{setTest:function(Ot){I||(Ot?lt(i.STENCIL_TEST):Tt(i.STENCIL_TEST))},setMask:function(Ot){nt!==Ot&&!I&&(i.stencilMask(Ot),nt=Ot)},setFunc:function(Ot,Zt,wt){(J!==Ot||mt!==Zt||ht!==wt)&&(i.stencilFunc(Ot,Zt,wt),J=Ot,mt=Zt,ht=wt)},setOp:function(Ot,Zt,wt){(dt!==Ot||Dt!==Zt||Kt!==wt)&&(i.stencilOp(Ot,Zt,wt),dt=Ot,Dt=Zt,Kt=wt)},setLocked:function(Ot){I=Ot},setClear:function(Ot){ct!==Ot&&(i.clearStencil(Ot),ct=Ot)},reset:function(){I=!1,nt=null,J=null,mt=null,ht=null,dt=null,Dt=null,Kt=null,ct=null}}}let r=new e,a=new n,o=new s,l={},c=new WeakMap,h={},u={},f={},d=new WeakMap,p=[],_=null,m=!1,g=null,x=null,w=null,M=null,E=null,T=null,y=null,A=new Jt(0,0,0),F=0,N=!1,D=null,B=null,Z=null,P=null,$=null,Q=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),W=!1,at=0,X=i.getParameter(i.VERSION);X.indexOf("WebGL")!==-1?(at=parseFloat(/^WebGL (\d)/.exec(X)[1]),W=at>=1):X.indexOf("OpenGL ES")!==-1&&(at=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),W=at>=2);let z=null,it={},Rt=i.getParameter(i.SCISSOR_BOX),kt=i.getParameter(i.VIEWPORT),et=new Se().fromArray(Rt),pt=new Se().fromArray(kt);function _t(I,nt,J,mt){let ht=new Uint8Array(4),dt=i.createTexture();i.bindTexture(I,dt),i.texParameteri(I,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(I,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Dt=0;Dt<J;Dt++)I===i.TEXTURE_3D||I===i.TEXTURE_2D_ARRAY?i.texImage3D(nt,0,i.RGBA,1,1,mt,0,i.RGBA,i.UNSIGNED_BYTE,ht):i.texImage2D(nt+Dt,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,ht);return dt}let Nt={};Nt[i.TEXTURE_2D]=_t(i.TEXTURE_2D,i.TEXTURE_2D,1),Nt[i.TEXTURE_CUBE_MAP]=_t(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Nt[i.TEXTURE_2D_ARRAY]=_t(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Nt[i.TEXTURE_3D]=_t(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),a.setClear(1),o.setClear(0),lt(i.DEPTH_TEST),a.setFunc(Lr),fn(!1),ve(zf),lt(i.CULL_FACE),We(Ws);function lt(I){h[I]!==!0&&(i.enable(I),h[I]=!0)}function Tt(I){h[I]!==!1&&(i.disable(I),h[I]=!1)}function oe(I,nt){return f[I]!==nt?(i.bindFramebuffer(I,nt),f[I]=nt,I===i.DRAW_FRAMEBUFFER&&(f[i.FRAMEBUFFER]=nt),I===i.FRAMEBUFFER&&(f[i.DRAW_FRAMEBUFFER]=nt),!0):!1}function Ft(I,nt){let J=p,mt=!1;if(I){J=d.get(nt),J===void 0&&(J=[],d.set(nt,J));let ht=I.textures;if(J.length!==ht.length||J[0]!==i.COLOR_ATTACHMENT0){for(let dt=0,Dt=ht.length;dt<Dt;dt++)J[dt]=i.COLOR_ATTACHMENT0+dt;J.length=ht.length,mt=!0}}else J[0]!==i.BACK&&(J[0]=i.BACK,mt=!0);mt&&i.drawBuffers(J)}function ee(I){return _!==I?(i.useProgram(I),_=I,!0):!1}let xe={[Xs]:i.FUNC_ADD,[d0]:i.FUNC_SUBTRACT,[p0]:i.FUNC_REVERSE_SUBTRACT};xe[m0]=i.MIN,xe[g0]=i.MAX;let Qt={[_0]:i.ZERO,[y0]:i.ONE,[x0]:i.SRC_COLOR,[Wf]:i.SRC_ALPHA,[E0]:i.SRC_ALPHA_SATURATE,[b0]:i.DST_COLOR,[M0]:i.DST_ALPHA,[v0]:i.ONE_MINUS_SRC_COLOR,[Xf]:i.ONE_MINUS_SRC_ALPHA,[S0]:i.ONE_MINUS_DST_COLOR,[w0]:i.ONE_MINUS_DST_ALPHA,[A0]:i.CONSTANT_COLOR,[T0]:i.ONE_MINUS_CONSTANT_COLOR,[R0]:i.CONSTANT_ALPHA,[C0]:i.ONE_MINUS_CONSTANT_ALPHA};function We(I,nt,J,mt,ht,dt,Dt,Kt,ct,Ot){if(I===Ws){m===!0&&(Tt(i.BLEND),m=!1);return}if(m===!1&&(lt(i.BLEND),m=!0),I!==f0){if(I!==g||Ot!==N){if((x!==Xs||E!==Xs)&&(i.blendEquation(i.FUNC_ADD),x=Xs,E=Xs),Ot)switch(I){case $r:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Gf:i.blendFunc(i.ONE,i.ONE);break;case Vf:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Hf:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:Wt("WebGLState: Invalid blending: ",I);break}else switch(I){case $r:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Gf:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Vf:Wt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Hf:Wt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Wt("WebGLState: Invalid blending: ",I);break}w=null,M=null,T=null,y=null,A.set(0,0,0),F=0,g=I,N=Ot}return}ht=ht||nt,dt=dt||J,Dt=Dt||mt,(nt!==x||ht!==E)&&(i.blendEquationSeparate(xe[nt],xe[ht]),x=nt,E=ht),(J!==w||mt!==M||dt!==T||Dt!==y)&&(i.blendFuncSeparate(Qt[J],Qt[mt],Qt[dt],Qt[Dt]),w=J,M=mt,T=dt,y=Dt),(Kt.equals(A)===!1||ct!==F)&&(i.blendColor(Kt.r,Kt.g,Kt.b,ct),A.copy(Kt),F=ct),g=I,N=!1}function Ue(I,nt){I.side===Ti?Tt(i.CULL_FACE):lt(i.CULL_FACE);let J=I.side===Nn;nt&&(J=!J),fn(J),I.blending===$r&&I.transparent===!1?We(Ws):We(I.blending,I.blendEquation,I.blendSrc,I.blendDst,I.blendEquationAlpha,I.blendSrcAlpha,I.blendDstAlpha,I.blendColor,I.blendAlpha,I.premultipliedAlpha),a.setFunc(I.depthFunc),a.setTest(I.depthTest),a.setMask(I.depthWrite),r.setMask(I.colorWrite);let mt=I.stencilWrite;o.setTest(mt),mt&&(o.setMask(I.stencilWriteMask),o.setFunc(I.stencilFunc,I.stencilRef,I.stencilFuncMask),o.setOp(I.stencilFail,I.stencilZFail,I.stencilZPass)),Be(I.polygonOffset,I.polygonOffsetFactor,I.polygonOffsetUnits),I.alphaToCoverage===!0?lt(i.SAMPLE_ALPHA_TO_COVERAGE):Tt(i.SAMPLE_ALPHA_TO_COVERAGE)}function fn(I){D!==I&&(I?i.frontFace(i.CW):i.frontFace(i.CCW),D=I)}function ve(I){I!==c0?(lt(i.CULL_FACE),I!==B&&(I===zf?i.cullFace(i.BACK):I===h0?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Tt(i.CULL_FACE),B=I}function le(I){I!==Z&&(W&&i.lineWidth(I),Z=I)}function Be(I,nt,J){I?(lt(i.POLYGON_OFFSET_FILL),(P!==nt||$!==J)&&(P=nt,$=J,a.getReversed()&&(nt=-nt,J=-J),i.polygonOffset(nt,J))):Tt(i.POLYGON_OFFSET_FILL)}function bn(I){I?lt(i.SCISSOR_TEST):Tt(i.SCISSOR_TEST)}function pn(I){I===void 0&&(I=i.TEXTURE0+Q-1),z!==I&&(i.activeTexture(I),z=I)}function ze(I,nt,J){J===void 0&&(z===null?J=i.TEXTURE0+Q-1:J=z);let mt=it[J];mt===void 0&&(mt={type:void 0,texture:void 0},it[J]=mt),(mt.type!==I||mt.texture!==nt)&&(z!==J&&(i.activeTexture(J),z=J),i.bindTexture(I,nt||Nt[I]),mt.type=I,mt.texture=nt)}function O(){let I=it[z];I!==void 0&&I.type!==void 0&&(i.bindTexture(I.type,null),I.type=void 0,I.texture=void 0)}function Sn(){try{i.compressedTexImage2D(...arguments)}catch(I){Wt("WebGLState:",I)}}function pe(){try{i.compressedTexImage3D(...arguments)}catch(I){Wt("WebGLState:",I)}}function Te(){try{i.texSubImage2D(...arguments)}catch(I){Wt("WebGLState:",I)}}function Mt(){try{i.texSubImage3D(...arguments)}catch(I){Wt("WebGLState:",I)}}function ke(){try{i.compressedTexSubImage2D(...arguments)}catch(I){Wt("WebGLState:",I)}}function Bt(){try{i.compressedTexSubImage3D(...arguments)}catch(I){Wt("WebGLState:",I)}}function Vt(){try{i.texStorage2D(...arguments)}catch(I){Wt("WebGLState:",I)}}function C(){try{i.texStorage3D(...arguments)}catch(I){Wt("WebGLState:",I)}}function b(){try{i.texImage2D(...arguments)}catch(I){Wt("WebGLState:",I)}}function V(){try{i.texImage3D(...arguments)}catch(I){Wt("WebGLState:",I)}}function ot(I){return u[I]!==void 0?u[I]:i.getParameter(I)}function st(I,nt){u[I]!==nt&&(i.pixelStorei(I,nt),u[I]=nt)}function ut(I){et.equals(I)===!1&&(i.scissor(I.x,I.y,I.z,I.w),et.copy(I))}function yt(I){pt.equals(I)===!1&&(i.viewport(I.x,I.y,I.z,I.w),pt.copy(I))}function j(I,nt){let J=c.get(nt);J===void 0&&(J=new WeakMap,c.set(nt,J));let mt=J.get(I);mt===void 0&&(mt=i.getUniformBlockIndex(nt,I.name),i.uniformBlockBinding(nt,mt,mt),J.set(I,mt))}function tt(I,nt,J){let ht=c.get(nt).get(I);l[ht]!==J&&(i.bindBufferBase(i.UNIFORM_BUFFER,ht,J),l[ht]=J)}function ft(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),a.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},z=null,it={},f={},l={},d=new WeakMap,p=[],_=null,m=!1,g=null,x=null,w=null,M=null,E=null,T=null,y=null,A=new Jt(0,0,0),F=0,N=!1,D=null,B=null,Z=null,P=null,$=null,et.set(0,0,i.canvas.width,i.canvas.height),pt.set(0,0,i.canvas.width,i.canvas.height),r.reset(),a.reset(),o.reset()}return{buffers:{color:r,depth:a,stencil:o},enable:lt,disable:Tt,bindFramebuffer:oe,drawBuffers:Ft,useProgram:ee,setBlending:We,setMaterial:Ue,setFlipSided:fn,setCullFace:ve,setLineWidth:le,setPolygonOffset:Be,setScissorTest:bn,activeTexture:pn,bindTexture:ze,unbindTexture:O,compressedTexImage2D:Sn,compressedTexImage3D:pe,texImage2D:b,texImage3D:V,pixelStorei:st,getParameter:ot,updateUBOMapping:j,uniformBlockBinding:tt,texStorage2D:Vt,texStorage3D:C,texSubImage2D:Te,texSubImage3D:Mt,compressedTexSubImage2D:ke,compressedTexSubImage3D:Bt,scissor:ut,viewport:yt,reset:ft}}function mA(i,t,e,n,s,r,a){let o=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new zt,h=new WeakMap,u=new Set,f,d=new WeakMap,p=new Set,_=new FinalizationRegistry(C=>p.delete(C)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(C,b){return m?new OffscreenCanvas(C,b):Va("canvas")}function x(C,b,V){let ot=1,st=Vt(C);if((st.width>V||st.height>V)&&(ot=V/Math.max(st.width,st.height)),ot<1)if(typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&C instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&C instanceof ImageBitmap||typeof VideoFrame<"u"&&C instanceof VideoFrame){let ut=Math.floor(ot*st.width),yt=Math.floor(ot*st.height);f===void 0&&(f=g(ut,yt));let j=b?g(ut,yt):f;return j.width=ut,j.height=yt,j.getContext("2d").drawImage(C,0,0,ut,yt),Ut("WebGLRenderer: Texture has been resized from ("+st.width+"x"+st.height+") to ("+ut+"x"+yt+")."),j}else return"data"in C&&Ut("WebGLRenderer: Image in DataTexture is too big ("+st.width+"x"+st.height+")."),C;return C}function w(C){return C.generateMipmaps}function M(C){i.generateMipmap(C)}function E(C){return C.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:C.isWebGL3DRenderTarget?i.TEXTURE_3D:C.isWebGLArrayRenderTarget||C.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function T(C,b,V,ot,st,ut=!1){if(C!==null){if(i[C]!==void 0)return i[C];Ut("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+C+"'")}let yt;ot&&(yt=t.get("EXT_texture_norm16"),yt||Ut("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let j=b;if(b===i.RED&&(V===i.FLOAT&&(j=i.R32F),V===i.HALF_FLOAT&&(j=i.R16F),V===i.UNSIGNED_BYTE&&(j=i.R8),V===i.UNSIGNED_SHORT&&yt&&(j=yt.R16_EXT),V===i.SHORT&&yt&&(j=yt.R16_SNORM_EXT)),b===i.RED_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.R8UI),V===i.UNSIGNED_SHORT&&(j=i.R16UI),V===i.UNSIGNED_INT&&(j=i.R32UI),V===i.BYTE&&(j=i.R8I),V===i.SHORT&&(j=i.R16I),V===i.INT&&(j=i.R32I)),b===i.RG&&(V===i.FLOAT&&(j=i.RG32F),V===i.HALF_FLOAT&&(j=i.RG16F),V===i.UNSIGNED_BYTE&&(j=i.RG8),V===i.UNSIGNED_SHORT&&yt&&(j=yt.RG16_EXT),V===i.SHORT&&yt&&(j=yt.RG16_SNORM_EXT)),b===i.RG_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.RG8UI),V===i.UNSIGNED_SHORT&&(j=i.RG16UI),V===i.UNSIGNED_INT&&(j=i.RG32UI),V===i.BYTE&&(j=i.RG8I),V===i.SHORT&&(j=i.RG16I),V===i.INT&&(j=i.RG32I)),b===i.RGB_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.RGB8UI),V===i.UNSIGNED_SHORT&&(j=i.RGB16UI),V===i.UNSIGNED_INT&&(j=i.RGB32UI),V===i.BYTE&&(j=i.RGB8I),V===i.SHORT&&(j=i.RGB16I),V===i.INT&&(j=i.RGB32I)),b===i.RGBA_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.RGBA8UI),V===i.UNSIGNED_SHORT&&(j=i.RGBA16UI),V===i.UNSIGNED_INT&&(j=i.RGBA32UI),V===i.BYTE&&(j=i.RGBA8I),V===i.SHORT&&(j=i.RGBA16I),V===i.INT&&(j=i.RGBA32I)),b===i.RGB&&(V===i.UNSIGNED_SHORT&&yt&&(j=yt.RGB16_EXT),V===i.SHORT&&yt&&(j=yt.RGB16_SNORM_EXT),V===i.UNSIGNED_INT_5_9_9_9_REV&&(j=i.RGB9_E5),V===i.UNSIGNED_INT_10F_11F_11F_REV&&(j=i.R11F_G11F_B10F)),b===i.RGBA){let tt=ut?Ga:he.getTransfer(st);V===i.FLOAT&&(j=i.RGBA32F),V===i.HALF_FLOAT&&(j=i.RGBA16F),V===i.UNSIGNED_BYTE&&(j=tt===we?i.SRGB8_ALPHA8:i.RGBA8),V===i.UNSIGNED_SHORT&&yt&&(j=yt.RGBA16_EXT),V===i.SHORT&&yt&&(j=yt.RGBA16_SNORM_EXT),V===i.UNSIGNED_SHORT_4_4_4_4&&(j=i.RGBA4),V===i.UNSIGNED_SHORT_5_5_5_1&&(j=i.RGB5_A1)}return(j===i.R16F||j===i.R32F||j===i.RG16F||j===i.RG32F||j===i.RGBA16F||j===i.RGBA32F)&&t.get("EXT_color_buffer_float"),j}function y(C,b){let V;return C?b===null||b===gi||b===qs?V=i.DEPTH24_STENCIL8:b===si?V=i.DEPTH32F_STENCIL8:b===Yr&&(V=i.DEPTH24_STENCIL8,Ut("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):b===null||b===gi||b===qs?V=i.DEPTH_COMPONENT24:b===si?V=i.DEPTH_COMPONENT32F:b===Yr&&(V=i.DEPTH_COMPONENT16),V}function A(C,b){return w(C)===!0||C.isFramebufferTexture&&C.minFilter!==hn&&C.minFilter!==In?Math.log2(Math.max(b.width,b.height))+1:C.mipmaps.length>0?C.mipmaps.length:C.isCompressedTexture&&Array.isArray(C.image)?b.mipmaps.length:1}function F(C){let b=new WeakRef(C);n.get(C).__ref=b,p.add(b),_.register(C,b,b)}function N(C){let b=n.get(C).__ref;b!==void 0&&(p.delete(b),_.unregister(b))}function D(C){Z(C.target)}function B(C){P(C.target)}function Z(C){C.removeEventListener("dispose",D),N(C),Q(C),C.isVideoTexture&&h.delete(C),C.isHTMLTexture&&u.delete(C)}function P(C){C.removeEventListener("dispose",B),N(C),at(C)}function $(){for(let C of p){let b=C.deref();b!==void 0&&(b.isRenderTarget===!0?P(b):Z(b))}p.clear(),u.clear()}function Q(C){let b=n.get(C);if(b.__webglInit===void 0)return;let V=C.source,ot=d.get(V);if(ot){let st=ot[b.__cacheKey];st.usedTimes--,st.usedTimes===0&&W(C),Object.keys(ot).length===0&&d.delete(V)}n.remove(C)}function W(C){let b=n.get(C);i.deleteTexture(b.__webglTexture);let V=C.source,ot=d.get(V);delete ot[b.__cacheKey],a.memory.textures--}function at(C){let b=n.get(C);b.__depthDisposeCallback&&b.__depthDisposeCallback();let V=C.depthTexture;if(V&&V.renderTarget===C&&Z(V),C.isWebGLCubeRenderTarget)for(let st=0;st<6;st++){if(Array.isArray(b.__webglFramebuffer[st]))for(let ut=0;ut<b.__webglFramebuffer[st].length;ut++)i.deleteFramebuffer(b.__webglFramebuffer[st][ut]);else i.deleteFramebuffer(b.__webglFramebuffer[st]);b.__webglDepthbuffer&&i.deleteRenderbuffer(b.__webglDepthbuffer[st])}else{if(Array.isArray(b.__webglFramebuffer))for(let st=0;st<b.__webglFramebuffer.length;st++)i.deleteFramebuffer(b.__webglFramebuffer[st]);else i.deleteFramebuffer(b.__webglFramebuffer);if(b.__webglDepthbuffer&&i.deleteRenderbuffer(b.__webglDepthbuffer),b.__webglMultisampledFramebuffer&&i.deleteFramebuffer(b.__webglMultisampledFramebuffer),b.__webglColorRenderbuffer)for(let st=0;st<b.__webglColorRenderbuffer.length;st++)b.__webglColorRenderbuffer[st]&&i.deleteRenderbuffer(b.__webglColorRenderbuffer[st]);b.__webglDepthRenderbuffer&&i.deleteRenderbuffer(b.__webglDepthRenderbuffer)}let ot=C.textures;for(let st=0,ut=ot.length;st<ut;st++){let yt=n.get(ot[st]);yt.__webglTexture&&(i.deleteTexture(yt.__webglTexture),a.memory.textures--),n.remove(ot[st])}n.remove(C)}let X=0;function z(){X=0}function it(){return X}function Rt(C){X=C}function kt(){let C=X;return C>=s.maxTextures&&Ut("WebGLTextures: Trying to use "+(C+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,C}function et(C){let b=[];return b.push(C.wrapS),b.push(C.wrapT),b.push(C.wrapR||0),b.push(C.magFilter),b.push(C.minFilter),b.push(C.anisotropy),b.push(C.internalFormat),b.push(C.format),b.push(C.type),b.push(C.generateMipmaps),b.push(C.mipmapsAutoUpdate),b.push(C.premultiplyAlpha),b.push(C.flipY),b.push(C.unpackAlignment),b.push(C.colorSpace),b.join()}function pt(C,b){let V=n.get(C);if(C.isVideoTexture&&ke(C),C.isRenderTargetTexture===!1&&C.isExternalTexture!==!0&&C.version>0&&V.__version!==C.version){let ot=C.image;if(ot===null)Ut("WebGLRenderer: Texture marked for update but no image data found.");else if(ot.complete===!1)Ut("WebGLRenderer: Texture marked for update but image is incomplete");else{Ue(V,C,b);return}}else C.isExternalTexture&&(V.__webglTexture=C.sourceTexture?C.sourceTexture:null);e.bindTexture(i.TEXTURE_2D,V.__webglTexture,i.TEXTURE0+b)}function _t(C,b){let V=n.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&V.__version!==C.version){Ue(V,C,b);return}else C.isExternalTexture&&(V.__webglTexture=C.sourceTexture?C.sourceTexture:null);e.bindTexture(i.TEXTURE_2D_ARRAY,V.__webglTexture,i.TEXTURE0+b)}function Nt(C,b){let V=n.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&V.__version!==C.version){Ue(V,C,b);return}e.bindTexture(i.TEXTURE_3D,V.__webglTexture,i.TEXTURE0+b)}function lt(C,b){let V=n.get(C);if(C.version>0&&V.__version!==C.version){fn(V,C,b);return}e.bindTexture(i.TEXTURE_CUBE_MAP,V.__webglTexture,i.TEXTURE0+b)}let Tt={[tc]:i.REPEAT,[Si]:i.CLAMP_TO_EDGE,[ec]:i.MIRRORED_REPEAT},oe={[hn]:i.NEAREST,[N0]:i.NEAREST_MIPMAP_NEAREST,[fo]:i.NEAREST_MIPMAP_LINEAR,[In]:i.LINEAR,[Tc]:i.LINEAR_MIPMAP_NEAREST,[Yi]:i.LINEAR_MIPMAP_LINEAR},Ft={[F0]:i.NEVER,[cd]:i.ALWAYS,[B0]:i.LESS,[od]:i.LEQUAL,[k0]:i.EQUAL,[ld]:i.GEQUAL,[z0]:i.GREATER,[G0]:i.NOTEQUAL};function ee(C,b){if(b.type===si&&t.has("OES_texture_float_linear")===!1&&(b.magFilter===In||b.magFilter===Tc||b.magFilter===fo||b.magFilter===Yi||b.minFilter===In||b.minFilter===Tc||b.minFilter===fo||b.minFilter===Yi)&&Ut("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(C,i.TEXTURE_WRAP_S,Tt[b.wrapS]),i.texParameteri(C,i.TEXTURE_WRAP_T,Tt[b.wrapT]),(C===i.TEXTURE_3D||C===i.TEXTURE_2D_ARRAY)&&i.texParameteri(C,i.TEXTURE_WRAP_R,Tt[b.wrapR]),i.texParameteri(C,i.TEXTURE_MAG_FILTER,oe[b.magFilter]),i.texParameteri(C,i.TEXTURE_MIN_FILTER,oe[b.minFilter]),b.compareFunction&&(i.texParameteri(C,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(C,i.TEXTURE_COMPARE_FUNC,Ft[b.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(b.magFilter===hn||b.minFilter!==fo&&b.minFilter!==Yi||b.type===si&&t.has("OES_texture_float_linear")===!1)return;if(b.anisotropy>1||n.get(b).__currentAnisotropy){let V=t.get("EXT_texture_filter_anisotropic");i.texParameterf(C,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(b.anisotropy,s.getMaxAnisotropy())),n.get(b).__currentAnisotropy=b.anisotropy}}}function xe(C,b){let V=!1;C.__webglInit===void 0&&(C.__webglInit=!0,b.addEventListener("dispose",D),F(b));let ot=b.source,st=d.get(ot);st===void 0&&(st={},d.set(ot,st));let ut=et(b);if(ut!==C.__cacheKey){st[ut]===void 0&&(st[ut]={texture:i.createTexture(),usedTimes:0},a.memory.textures++,V=!0),st[ut].usedTimes++;let yt=st[C.__cacheKey];yt!==void 0&&(st[C.__cacheKey].usedTimes--,yt.usedTimes===0&&W(b)),C.__cacheKey=ut,C.__webglTexture=st[ut].texture}return V}function Qt(C,b,V){return Math.floor(Math.floor(C/V)/b)}function We(C,b,V,ot){let ut=C.updateRanges;if(ut.length===0)e.texSubImage2D(i.TEXTURE_2D,0,0,0,b.width,b.height,V,ot,b.data);else{ut.sort((I,nt)=>I.start-nt.start);let yt=0;for(let I=1;I<ut.length;I++){let nt=ut[yt],J=ut[I],mt=nt.start+nt.count,ht=Qt(J.start,b.width,4),dt=Qt(nt.start,b.width,4);J.start<=mt+1&&ht===dt&&Qt(J.start+J.count-1,b.width,4)===ht?nt.count=Math.max(nt.count,J.start+J.count-nt.start):(++yt,ut[yt]=J)}ut.length=yt+1;let j=e.getParameter(i.UNPACK_ROW_LENGTH),tt=e.getParameter(i.UNPACK_SKIP_PIXELS),ft=e.getParameter(i.UNPACK_SKIP_ROWS);e.pixelStorei(i.UNPACK_ROW_LENGTH,b.width);for(let I=0,nt=ut.length;I<nt;I++){let J=ut[I],mt=Math.floor(J.start/4),ht=Math.ceil(J.count/4),dt=mt%b.width,Dt=Math.floor(mt/b.width),Kt=ht,ct=1;e.pixelStorei(i.UNPACK_SKIP_PIXELS,dt),e.pixelStorei(i.UNPACK_SKIP_ROWS,Dt),e.texSubImage2D(i.TEXTURE_2D,0,dt,Dt,Kt,ct,V,ot,b.data)}C.clearUpdateRanges(),e.pixelStorei(i.UNPACK_ROW_LENGTH,j),e.pixelStorei(i.UNPACK_SKIP_PIXELS,tt),e.pixelStorei(i.UNPACK_SKIP_ROWS,ft)}}function Ue(C,b,V){let ot=i.TEXTURE_2D;(b.isDataArrayTexture||b.isCompressedArrayTexture)&&(ot=i.TEXTURE_2D_ARRAY),b.isData3DTexture&&(ot=i.TEXTURE_3D);let st=xe(C,b),ut=b.source;e.bindTexture(ot,C.__webglTexture,i.TEXTURE0+V);let yt=n.get(ut);if(ut.version!==yt.__version||st===!0){if(e.activeTexture(i.TEXTURE0+V),(typeof ImageBitmap<"u"&&b.image instanceof ImageBitmap)===!1){let ct=he.getPrimaries(he.workingColorSpace),Ot=b.colorSpace===Ji?null:he.getPrimaries(b.colorSpace),Zt=b.colorSpace===Ji||ct===Ot?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,b.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Zt)}e.pixelStorei(i.UNPACK_ALIGNMENT,b.unpackAlignment);let tt=x(b.image,!1,s.maxTextureSize);tt=Bt(b,tt);let ft=r.convert(b.format,b.colorSpace),I=r.convert(b.type),nt=T(b.internalFormat,ft,I,b.normalized,b.colorSpace,b.isVideoTexture);ee(ot,b);let J,mt=b.mipmaps,ht=b.isVideoTexture!==!0,dt=yt.__version===void 0||st===!0,Dt=ut.dataReady,Kt=A(b,tt);if(b.isDepthTexture)nt=y(b.format===Zi,b.type),dt&&(ht?e.texStorage2D(i.TEXTURE_2D,1,nt,tt.width,tt.height):e.texImage2D(i.TEXTURE_2D,0,nt,tt.width,tt.height,0,ft,I,null));else if(b.isDataTexture)if(mt.length>0){ht&&dt&&e.texStorage2D(i.TEXTURE_2D,Kt,nt,mt[0].width,mt[0].height);for(let ct=0,Ot=mt.length;ct<Ot;ct++)J=mt[ct],ht?Dt&&e.texSubImage2D(i.TEXTURE_2D,ct,0,0,J.width,J.height,ft,I,J.data):e.texImage2D(i.TEXTURE_2D,ct,nt,J.width,J.height,0,ft,I,J.data);b.generateMipmaps=!1}else ht?(dt&&e.texStorage2D(i.TEXTURE_2D,Kt,nt,tt.width,tt.height),Dt&&We(b,tt,ft,I)):e.texImage2D(i.TEXTURE_2D,0,nt,tt.width,tt.height,0,ft,I,tt.data);else if(b.isCompressedTexture)if(b.isCompressedArrayTexture){ht&&dt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Kt,nt,mt[0].width,mt[0].height,tt.depth);for(let ct=0,Ot=mt.length;ct<Ot;ct++)if(J=mt[ct],b.format!==ri)if(ft!==null)if(ht){if(Dt)if(b.layerUpdates.size>0){let Zt=xd(J.width,J.height,b.format,b.type);for(let wt of b.layerUpdates){let me=J.data.subarray(wt*Zt/J.data.BYTES_PER_ELEMENT,(wt+1)*Zt/J.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ct,0,0,wt,J.width,J.height,1,ft,me)}}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ct,0,0,0,J.width,J.height,tt.depth,ft,J.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,ct,nt,J.width,J.height,tt.depth,0,J.data,0,0);else Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ht?Dt&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,ct,0,0,0,J.width,J.height,tt.depth,ft,I,J.data):e.texImage3D(i.TEXTURE_2D_ARRAY,ct,nt,J.width,J.height,tt.depth,0,ft,I,J.data);b.layerUpdates.size>0&&b.clearLayerUpdates()}else{ht&&dt&&e.texStorage2D(i.TEXTURE_2D,Kt,nt,mt[0].width,mt[0].height);for(let ct=0,Ot=mt.length;ct<Ot;ct++)J=mt[ct],b.format!==ri?ft!==null?ht?Dt&&e.compressedTexSubImage2D(i.TEXTURE_2D,ct,0,0,J.width,J.height,ft,J.data):e.compressedTexImage2D(i.TEXTURE_2D,ct,nt,J.width,J.height,0,J.data):Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ht?Dt&&e.texSubImage2D(i.TEXTURE_2D,ct,0,0,J.width,J.height,ft,I,J.data):e.texImage2D(i.TEXTURE_2D,ct,nt,J.width,J.height,0,ft,I,J.data)}else if(b.isDataArrayTexture)if(ht){if(dt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Kt,nt,tt.width,tt.height,tt.depth),Dt)if(b.layerUpdates.size>0){let ct=xd(tt.width,tt.height,b.format,b.type);for(let Ot of b.layerUpdates){let Zt=tt.data.subarray(Ot*ct/tt.data.BYTES_PER_ELEMENT,(Ot+1)*ct/tt.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Ot,tt.width,tt.height,1,ft,I,Zt)}b.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,tt.width,tt.height,tt.depth,ft,I,tt.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,nt,tt.width,tt.height,tt.depth,0,ft,I,tt.data);else if(b.isData3DTexture)ht?(dt&&e.texStorage3D(i.TEXTURE_3D,Kt,nt,tt.width,tt.height,tt.depth),Dt&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,tt.width,tt.height,tt.depth,ft,I,tt.data)):e.texImage3D(i.TEXTURE_3D,0,nt,tt.width,tt.height,tt.depth,0,ft,I,tt.data);else if(b.isFramebufferTexture){if(dt)if(ht)e.texStorage2D(i.TEXTURE_2D,Kt,nt,tt.width,tt.height);else{let ct=tt.width,Ot=tt.height;for(let Zt=0;Zt<Kt;Zt++)e.texImage2D(i.TEXTURE_2D,Zt,nt,ct,Ot,0,ft,I,null),ct>>=1,Ot>>=1}}else if(b.isHTMLTexture){if("texElementImage2D"in i){let ct=i.canvas;if(ct.hasAttribute("layoutsubtree")||ct.setAttribute("layoutsubtree","true"),tt.parentNode!==ct){ct.appendChild(tt),u.add(b),ct.onpaint=Ot=>{let Zt=Ot.changedElements;for(let wt of u)Zt.includes(wt.image)&&(wt.needsUpdate=!0)},ct.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,tt);else{let Zt=i.RGBA,wt=i.RGBA,me=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,Zt,wt,me,tt)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(mt.length>0){if(ht&&dt){let ct=Vt(mt[0]);e.texStorage2D(i.TEXTURE_2D,Kt,nt,ct.width,ct.height)}for(let ct=0,Ot=mt.length;ct<Ot;ct++)J=mt[ct],ht?Dt&&e.texSubImage2D(i.TEXTURE_2D,ct,0,0,ft,I,J):e.texImage2D(i.TEXTURE_2D,ct,nt,ft,I,J);b.generateMipmaps=!1}else if(ht){if(dt){let ct=Vt(tt);e.texStorage2D(i.TEXTURE_2D,Kt,nt,ct.width,ct.height)}Dt&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,ft,I,tt)}else e.texImage2D(i.TEXTURE_2D,0,nt,ft,I,tt);w(b)&&b.mipmapsAutoUpdate===!0&&M(ot),yt.__version=ut.version,b.onUpdate&&b.onUpdate(b)}C.__version=b.version}function fn(C,b,V){if(b.image.length!==6)return;let ot=xe(C,b),st=b.source;e.bindTexture(i.TEXTURE_CUBE_MAP,C.__webglTexture,i.TEXTURE0+V);let ut=n.get(st);if(st.version!==ut.__version||ot===!0){e.activeTexture(i.TEXTURE0+V);let yt=he.getPrimaries(he.workingColorSpace),j=b.colorSpace===Ji?null:he.getPrimaries(b.colorSpace),tt=b.colorSpace===Ji||yt===j?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,b.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),e.pixelStorei(i.UNPACK_ALIGNMENT,b.unpackAlignment),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,tt);let ft=b.isCompressedTexture||b.image[0].isCompressedTexture,I=b.image[0]&&b.image[0].isDataTexture,nt=[];for(let wt=0;wt<6;wt++)!ft&&!I?nt[wt]=x(b.image[wt],!0,s.maxCubemapSize):nt[wt]=I?b.image[wt].image:b.image[wt],nt[wt]=Bt(b,nt[wt]);let J=nt[0],mt=r.convert(b.format,b.colorSpace),ht=r.convert(b.type),dt=T(b.internalFormat,mt,ht,b.normalized,b.colorSpace),Dt=b.isVideoTexture!==!0,Kt=ut.__version===void 0||ot===!0,ct=st.dataReady,Ot=A(b,J);ee(i.TEXTURE_CUBE_MAP,b);let Zt;if(b.isDepthTexture){if(dt=y(b.format===Zi,b.type),Kt)if(Dt)e.texStorage2D(i.TEXTURE_CUBE_MAP,1,dt,J.width,J.height);else for(let wt=0;wt<6;wt++)e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,0,dt,J.width,J.height,0,mt,ht,null)}else if(ft){Dt&&Kt&&e.texStorage2D(i.TEXTURE_CUBE_MAP,Ot,dt,J.width,J.height);for(let wt=0;wt<6;wt++){Zt=nt[wt].mipmaps;for(let me=0;me<Zt.length;me++){let Xe=Zt[me];b.format!==ri?mt!==null?Dt?ct&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me,0,0,Xe.width,Xe.height,mt,Xe.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me,dt,Xe.width,Xe.height,0,Xe.data):Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me,0,0,Xe.width,Xe.height,mt,ht,Xe.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me,dt,Xe.width,Xe.height,0,mt,ht,Xe.data)}}}else{if(Zt=b.mipmaps,Dt&&Kt){Zt.length>0&&Ot++;let wt=Vt(nt[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,Ot,dt,wt.width,wt.height)}for(let wt=0;wt<6;wt++)if(I){Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,0,0,0,nt[wt].width,nt[wt].height,mt,ht,nt[wt].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,0,dt,nt[wt].width,nt[wt].height,0,mt,ht,nt[wt].data);for(let me=0;me<Zt.length;me++){let yi=Zt[me].image[wt].image;Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me+1,0,0,yi.width,yi.height,mt,ht,yi.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me+1,dt,yi.width,yi.height,0,mt,ht,yi.data)}}else{Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,0,0,0,mt,ht,nt[wt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,0,dt,mt,ht,nt[wt]);for(let me=0;me<Zt.length;me++){let Xe=Zt[me];Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me+1,0,0,mt,ht,Xe.image[wt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,me+1,dt,mt,ht,Xe.image[wt])}}}w(b)&&b.mipmapsAutoUpdate===!0&&M(i.TEXTURE_CUBE_MAP),ut.__version=st.version,b.onUpdate&&b.onUpdate(b)}C.__version=b.version}function ve(C,b,V,ot,st,ut){let yt=r.convert(V.format,V.colorSpace),j=r.convert(V.type),tt=T(V.internalFormat,yt,j,V.normalized,V.colorSpace),ft=n.get(b),I=n.get(V);if(I.__renderTarget=b,!ft.__hasExternalTextures){let nt=Math.max(1,b.width>>ut),J=Math.max(1,b.height>>ut);st===i.TEXTURE_3D||st===i.TEXTURE_2D_ARRAY?e.texImage3D(st,ut,tt,nt,J,b.depth,0,yt,j,null):e.texImage2D(st,ut,tt,nt,J,0,yt,j,null)}e.bindFramebuffer(i.FRAMEBUFFER,C),Mt(b)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ot,st,I.__webglTexture,0,Te(b)):(st===i.TEXTURE_2D||st>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&st<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,ot,st,I.__webglTexture,ut),e.bindFramebuffer(i.FRAMEBUFFER,null)}function le(C,b,V){if(i.bindRenderbuffer(i.RENDERBUFFER,C),b.depthBuffer){let ot=b.depthTexture,st=ot&&ot.isDepthTexture?ot.type:null,ut=y(b.stencilBuffer,st),yt=b.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;Mt(b)?o.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Te(b),ut,b.width,b.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,Te(b),ut,b.width,b.height):i.renderbufferStorage(i.RENDERBUFFER,ut,b.width,b.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,yt,i.RENDERBUFFER,C)}else{let ot=b.textures;for(let st=0;st<ot.length;st++){let ut=ot[st],yt=r.convert(ut.format,ut.colorSpace),j=r.convert(ut.type),tt=T(ut.internalFormat,yt,j,ut.normalized,ut.colorSpace);Mt(b)?o.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Te(b),tt,b.width,b.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,Te(b),tt,b.width,b.height):i.renderbufferStorage(i.RENDERBUFFER,tt,b.width,b.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Be(C,b,V){let ot=b.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(i.FRAMEBUFFER,C),!(b.depthTexture&&b.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let st=n.get(b.depthTexture);st.__renderTarget=b;let ut=ot?b.depthTexture.image[0]:b.depthTexture.image;(!st.__webglTexture||ut.width!==b.width||ut.height!==b.height)&&(ut.width=b.width,ut.height=b.height,b.depthTexture.needsUpdate=!0),ot?lt(b.depthTexture,0):pt(b.depthTexture,0);let yt=st.__webglTexture,j=Te(b),tt=ot?i.TEXTURE_CUBE_MAP_POSITIVE_X+V:i.TEXTURE_2D,ft=b.depthTexture.format===Zi?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(b.depthTexture.format===Vi)Mt(b)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ft,tt,yt,0,j):i.framebufferTexture2D(i.FRAMEBUFFER,ft,tt,yt,0);else if(b.depthTexture.format===Zi)Mt(b)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ft,tt,yt,0,j):i.framebufferTexture2D(i.FRAMEBUFFER,ft,tt,yt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function bn(C){let b=n.get(C),V=C.isWebGLCubeRenderTarget===!0;if(b.__boundDepthTexture!==C.depthTexture){let ot=C.depthTexture;if(b.__depthDisposeCallback&&b.__depthDisposeCallback(),ot){let st=()=>{delete b.__boundDepthTexture,delete b.__depthDisposeCallback,ot.removeEventListener("dispose",st)};ot.addEventListener("dispose",st),b.__depthDisposeCallback=st}b.__boundDepthTexture=ot}if(C.depthTexture&&!b.__autoAllocateDepthBuffer)if(V)for(let ot=0;ot<6;ot++)Be(b.__webglFramebuffer[ot],C,ot);else C.texture.mipmaps.length>0?Be(b.__webglFramebuffer[0],C,0):Be(b.__webglFramebuffer,C,0);else if(V){b.__webglDepthbuffer=[];for(let ot=0;ot<6;ot++)if(e.bindFramebuffer(i.FRAMEBUFFER,b.__webglFramebuffer[ot]),b.__webglDepthbuffer[ot]===void 0)b.__webglDepthbuffer[ot]=i.createRenderbuffer(),le(b.__webglDepthbuffer[ot],C,!1);else{let st=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ut=b.__webglDepthbuffer[ot];i.bindRenderbuffer(i.RENDERBUFFER,ut),i.framebufferRenderbuffer(i.FRAMEBUFFER,st,i.RENDERBUFFER,ut)}}else if(C.texture.mipmaps.length>0?e.bindFramebuffer(i.FRAMEBUFFER,b.__webglFramebuffer[0]):e.bindFramebuffer(i.FRAMEBUFFER,b.__webglFramebuffer),b.__webglDepthbuffer===void 0)b.__webglDepthbuffer=i.createRenderbuffer(),le(b.__webglDepthbuffer,C,!1);else{let st=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ut=b.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,ut),i.framebufferRenderbuffer(i.FRAMEBUFFER,st,i.RENDERBUFFER,ut)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function pn(C,b,V){let ot=n.get(C);b!==void 0&&ve(ot.__webglFramebuffer,C,C.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),V!==void 0&&bn(C)}function ze(C){let b=C.texture,V=n.get(C),ot=n.get(b);C.addEventListener("dispose",B),F(C);let st=C.textures,ut=C.isWebGLCubeRenderTarget===!0,yt=st.length>1;if(yt||(ot.__webglTexture===void 0&&(ot.__webglTexture=i.createTexture()),ot.__version=b.version,a.memory.textures++),ut){V.__webglFramebuffer=[];for(let j=0;j<6;j++)if(b.mipmaps.length>0){V.__webglFramebuffer[j]=[];for(let tt=0;tt<b.mipmaps.length;tt++)V.__webglFramebuffer[j][tt]=i.createFramebuffer()}else V.__webglFramebuffer[j]=i.createFramebuffer()}else{if(b.mipmaps.length>0){V.__webglFramebuffer=[];for(let j=0;j<b.mipmaps.length;j++)V.__webglFramebuffer[j]=i.createFramebuffer()}else V.__webglFramebuffer=i.createFramebuffer();if(yt)for(let j=0,tt=st.length;j<tt;j++){let ft=n.get(st[j]);ft.__webglTexture===void 0&&(ft.__webglTexture=i.createTexture(),a.memory.textures++)}if(C.samples>0&&Mt(C)===!1){V.__webglMultisampledFramebuffer=i.createFramebuffer(),V.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let j=0;j<st.length;j++){let tt=st[j];V.__webglColorRenderbuffer[j]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,V.__webglColorRenderbuffer[j]);let ft=r.convert(tt.format,tt.colorSpace),I=r.convert(tt.type),nt=T(tt.internalFormat,ft,I,tt.normalized,tt.colorSpace,C.isXRRenderTarget===!0),J=Te(C);i.renderbufferStorageMultisample(i.RENDERBUFFER,J,nt,C.width,C.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+j,i.RENDERBUFFER,V.__webglColorRenderbuffer[j])}i.bindRenderbuffer(i.RENDERBUFFER,null),C.depthBuffer&&(V.__webglDepthRenderbuffer=i.createRenderbuffer(),le(V.__webglDepthRenderbuffer,C,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(ut){e.bindTexture(i.TEXTURE_CUBE_MAP,ot.__webglTexture),ee(i.TEXTURE_CUBE_MAP,b);for(let j=0;j<6;j++)if(b.mipmaps.length>0)for(let tt=0;tt<b.mipmaps.length;tt++)ve(V.__webglFramebuffer[j][tt],C,b,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+j,tt);else ve(V.__webglFramebuffer[j],C,b,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+j,0);w(b)?M(i.TEXTURE_CUBE_MAP):b.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),e.unbindTexture()}else if(yt){for(let j=0,tt=st.length;j<tt;j++){let ft=st[j],I=n.get(ft),nt=i.TEXTURE_2D;(C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(nt=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(nt,I.__webglTexture),ee(nt,ft),ve(V.__webglFramebuffer,C,ft,i.COLOR_ATTACHMENT0+j,nt,0),w(ft)&&M(nt)}e.unbindTexture()}else{let j=i.TEXTURE_2D;if((C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(j=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(j,ot.__webglTexture),ee(j,b),b.mipmaps.length>0)for(let tt=0;tt<b.mipmaps.length;tt++)ve(V.__webglFramebuffer[tt],C,b,i.COLOR_ATTACHMENT0,j,tt);else ve(V.__webglFramebuffer,C,b,i.COLOR_ATTACHMENT0,j,0);w(b)?M(j):b.mipmaps.length>0&&i.texParameteri(j,i.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),e.unbindTexture()}C.depthBuffer&&bn(C)}function O(C){let b=C.textures;for(let V=0,ot=b.length;V<ot;V++){let st=b[V];if(w(st)&&st.mipmapsAutoUpdate===!0){let ut=E(C),yt=n.get(st).__webglTexture;e.bindTexture(ut,yt),M(ut),e.unbindTexture()}}}let Sn=[];function pe(C){if(C.samples>0){if(Mt(C)===!1){let b=C.textures,V=C.width,ot=C.height,st=i.COLOR_BUFFER_BIT,ut=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,yt=n.get(C),j=b.length>1;if(j)for(let ft=0;ft<b.length;ft++)e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,yt.__webglMultisampledFramebuffer),C.texture.mipmaps.length>0?e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglFramebuffer[0]):e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglFramebuffer);for(let ft=0;ft<b.length;ft++){if(C.resolveDepthBuffer&&(C.depthBuffer&&(st|=i.DEPTH_BUFFER_BIT),C.stencilBuffer&&C.resolveStencilBuffer&&(st|=i.STENCIL_BUFFER_BIT)),j){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,yt.__webglColorRenderbuffer[ft]);let I=n.get(b[ft]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,I,0)}i.blitFramebuffer(0,0,V,ot,0,0,V,ot,st,i.NEAREST),l===!0&&(Sn.length=0,Sn.push(i.COLOR_ATTACHMENT0+ft),C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&Sn.push(ut),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Sn))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),j)for(let ft=0;ft<b.length;ft++){e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.RENDERBUFFER,yt.__webglColorRenderbuffer[ft]);let I=n.get(b[ft]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.TEXTURE_2D,I,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglMultisampledFramebuffer)}else if(C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&l){let b=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[b])}}}function Te(C){return Math.min(s.maxSamples,C.samples)}function Mt(C){let b=n.get(C);return C.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&b.__useRenderToTexture!==!1}function ke(C){let b=a.render.frame;h.get(C)!==b&&(h.set(C,b),C.update())}function Bt(C,b){let V=C.colorSpace,ot=C.format,st=C.type;return C.isCompressedTexture===!0||C.isVideoTexture===!0||V!==za&&V!==Ji&&(he.getTransfer(V)===we?(ot!==ri||st!==kn)&&Ut("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Wt("WebGLTextures: Unsupported texture color space:",V)),b}function Vt(C){return typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement?(c.width=C.naturalWidth||C.width,c.height=C.naturalHeight||C.height):typeof VideoFrame<"u"&&C instanceof VideoFrame?(c.width=C.displayWidth,c.height=C.displayHeight):(c.width=C.width,c.height=C.height),c}this.allocateTextureUnit=kt,this.resetTextureUnits=z,this.getTextureUnits=it,this.setTextureUnits=Rt,this.setTexture2D=pt,this.setTexture2DArray=_t,this.setTexture3D=Nt,this.setTextureCube=lt,this.rebindTextures=pn,this.setupRenderTarget=ze,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=pe,this.setupDepthRenderbuffer=bn,this.setupFrameBufferTexture=ve,this.useMultisampledRTT=Mt,this.dispose=$}function gA(i,t){function e(n,s=Ji){let r,a=he.getTransfer(s);if(n===kn)return i.UNSIGNED_BYTE;if(n===Cc)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Pc)return i.UNSIGNED_SHORT_5_5_5_1;if(n===nd)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===id)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===td)return i.BYTE;if(n===ed)return i.SHORT;if(n===Yr)return i.UNSIGNED_SHORT;if(n===Rc)return i.INT;if(n===gi)return i.UNSIGNED_INT;if(n===si)return i.FLOAT;if(n===_i)return i.HALF_FLOAT;if(n===sd)return i.ALPHA;if(n===rd)return i.RGB;if(n===ri)return i.RGBA;if(n===Vi)return i.DEPTH_COMPONENT;if(n===Zi)return i.DEPTH_STENCIL;if(n===ad)return i.RED;if(n===Ic)return i.RED_INTEGER;if(n===ys)return i.RG;if(n===Lc)return i.RG_INTEGER;if(n===Nc)return i.RGBA_INTEGER;if(n===po||n===mo||n===go||n===_o)if(a===we)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===po)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===mo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===go)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===_o)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===po)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===mo)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===go)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===_o)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Dc||n===Oc||n===Uc||n===Fc)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Dc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Oc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Uc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Fc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Bc||n===kc||n===zc||n===Gc||n===Vc||n===yo||n===Hc)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Bc||n===kc)return a===we?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===zc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Gc)return r.COMPRESSED_R11_EAC;if(n===Vc)return r.COMPRESSED_SIGNED_R11_EAC;if(n===yo)return r.COMPRESSED_RG11_EAC;if(n===Hc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Wc||n===Xc||n===$c||n===qc||n===Yc||n===Zc||n===Jc||n===Kc||n===jc||n===Qc||n===th||n===eh||n===nh||n===ih)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Wc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Xc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===$c)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===qc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Yc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Zc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Jc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Kc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===jc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Qc)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===th)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===eh)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===nh)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===ih)return a===we?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===sh||n===rh||n===ah)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===sh)return a===we?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===rh)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===ah)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===oh||n===lh||n===xo||n===ch)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===oh)return r.COMPRESSED_RED_RGTC1_EXT;if(n===lh)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===xo)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===ch)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===qs?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}var _A=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,yA=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Rd=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let n=new to(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=n}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new Ai({vertexShader:_A,fragmentShader:yA,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new Bn(new Vs(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Cd=class extends mi{constructor(t,e){super();let n=this,s=null,r=1,a=null,o="local-floor",l=1,c=null,h=null,u=null,f=null,d=null,p=null,_=typeof XRWebGLBinding<"u",m=new Rd,g={},x=e.getContextAttributes(),w=null,M=null,E=[],T=[],y=new zt,A=null,F=null,N=new Pn;N.viewport=new Se;let D=new Pn;D.viewport=new Se;let B=[N,D],Z=new bc,P=null,$=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(et){let pt=E[et];return pt===void 0&&(pt=new Br,E[et]=pt),pt.getTargetRaySpace()},this.getControllerGrip=function(et){let pt=E[et];return pt===void 0&&(pt=new Br,E[et]=pt),pt.getGripSpace()},this.getHand=function(et){let pt=E[et];return pt===void 0&&(pt=new Br,E[et]=pt),pt.getHandSpace()};function Q(et){let pt=T.indexOf(et.inputSource);if(pt===-1)return;let _t=E[pt];_t!==void 0&&(_t.update(et.inputSource,et.frame,c||a),_t.dispatchEvent({type:et.type,data:et.inputSource}))}function W(){s.removeEventListener("select",Q),s.removeEventListener("selectstart",Q),s.removeEventListener("selectend",Q),s.removeEventListener("squeeze",Q),s.removeEventListener("squeezestart",Q),s.removeEventListener("squeezeend",Q),s.removeEventListener("end",W),s.removeEventListener("inputsourceschange",at);for(let et=0;et<E.length;et++){let pt=T[et];pt!==null&&(T[et]=null,E[et].disconnect(pt))}P=null,$=null,m.reset();for(let et in g)delete g[et];if(t.setRenderTarget(w),d=null,f=null,u=null,s=null,M=null,kt.stop(),n.isPresenting=!1,t.setPixelRatio(A),t.setSize(y.width,y.height,!1),F!==null){let et=F.camera;et.fov=F.fov,et.zoom=F.zoom,et.updateProjectionMatrix(),F=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(et){r=et,n.isPresenting===!0&&Ut("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(et){o=et,n.isPresenting===!0&&Ut("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||a},this.setReferenceSpace=function(et){c=et},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(et){if(s=et,s!==null){if(w=t.getRenderTarget(),s.addEventListener("select",Q),s.addEventListener("selectstart",Q),s.addEventListener("selectend",Q),s.addEventListener("squeeze",Q),s.addEventListener("squeezestart",Q),s.addEventListener("squeezeend",Q),s.addEventListener("end",W),s.addEventListener("inputsourceschange",at),x.xrCompatible!==!0&&await e.makeXRCompatible(),A=t.getPixelRatio(),t.getSize(y),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let _t=null,Nt=null,lt=null;x.depth&&(lt=x.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,_t=x.stencil?Zi:Vi,Nt=x.stencil?qs:gi);let Tt={colorFormat:e.RGBA8,depthFormat:lt,scaleFactor:r};u=this.getBinding(),f=u.createProjectionLayer(Tt),s.updateRenderState({layers:[f]}),t.setPixelRatio(1),t.setSize(f.textureWidth,f.textureHeight,!1),M=new Yn(f.textureWidth,f.textureHeight,{format:ri,type:kn,depthTexture:new qi(f.textureWidth,f.textureHeight,Nt,void 0,void 0,void 0,void 0,void 0,void 0,_t),stencilBuffer:x.stencil,colorSpace:t.outputColorSpace,samples:x.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let _t={antialias:x.antialias,alpha:!0,depth:x.depth,stencil:x.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,e,_t),s.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),M=new Yn(d.framebufferWidth,d.framebufferHeight,{format:ri,type:kn,colorSpace:t.outputColorSpace,stencilBuffer:x.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}M.isXRRenderTarget=!0,this.setFoveation(l),c=null,a=await s.requestReferenceSpace(o),kt.setContext(s),kt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function at(et){for(let pt=0;pt<et.removed.length;pt++){let _t=et.removed[pt],Nt=T.indexOf(_t);Nt>=0&&(T[Nt]=null,E[Nt].disconnect(_t))}for(let pt=0;pt<et.added.length;pt++){let _t=et.added[pt],Nt=T.indexOf(_t);if(Nt===-1){for(let Tt=0;Tt<E.length;Tt++)if(Tt>=T.length){T.push(_t),Nt=Tt;break}else if(T[Tt]===null){T[Tt]=_t,Nt=Tt;break}if(Nt===-1)break}let lt=E[Nt];lt&&lt.connect(_t)}}function X(et,pt){pt===null?et.matrixWorld.copy(et.matrix):et.matrixWorld.multiplyMatrices(pt.matrixWorld,et.matrix),et.matrixWorldInverse.copy(et.matrixWorld).invert()}this.updateCamera=function(et){if(s===null)return;let pt=et.near,_t=et.far;m.texture!==null&&(m.depthNear>0&&(pt=m.depthNear),m.depthFar>0&&(_t=m.depthFar)),Z.near=D.near=N.near=pt,Z.far=D.far=N.far=_t,(P!==Z.near||$!==Z.far)&&(s.updateRenderState({depthNear:Z.near,depthFar:Z.far}),P=Z.near,$=Z.far),Z.layers.mask=et.layers.mask|6,N.layers.mask=Z.layers.mask&-5,D.layers.mask=Z.layers.mask&-3;let Nt=et.parent,lt=Z.cameras;X(Z,Nt);for(let Tt=0;Tt<lt.length;Tt++)X(lt[Tt],Nt);Z.projectionMatrix.copy(N.projectionMatrix),Z.projectionMatrixInverse.copy(N.projectionMatrixInverse),F===null&&et.isPerspectiveCamera&&(F={camera:et,fov:et.fov,zoom:et.zoom}),z(et,Z,Nt)};function z(et,pt,_t){_t===null?et.matrix.copy(pt.matrixWorld):(et.matrix.copy(_t.matrixWorld),et.matrix.invert(),et.matrix.multiply(pt.matrixWorld)),et.matrix.decompose(et.position,et.quaternion,et.scale),et.updateMatrixWorld(!0),et.projectionMatrix.copy(pt.projectionMatrix),et.projectionMatrixInverse.copy(pt.projectionMatrixInverse),et.isPerspectiveCamera&&(et.fov=Or*2*Math.atan(1/et.projectionMatrix.elements[5]),et.zoom=1)}this.getCamera=function(){return Z},this.getFoveation=function(){if(!(f===null&&d===null))return l},this.setFoveation=function(et){l=et,f!==null&&(f.fixedFoveation=et),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=et)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(Z)},this.getCameraTexture=function(et){return g[et]};let it=null;function Rt(et,pt){if(h=pt.getViewerPose(c||a),p=pt,h!==null){let _t=h.views;d!==null&&(t.setRenderTargetFramebuffer(M,d.framebuffer),t.setRenderTarget(M));let Nt=!1;_t.length!==Z.cameras.length&&(Z.cameras.length=0,Nt=!0);for(let Ft=0;Ft<_t.length;Ft++){let ee=_t[Ft],xe=null;if(d!==null)xe=d.getViewport(ee);else{let We=u.getViewSubImage(f,ee);xe=We.viewport,Ft===0&&(t.setRenderTargetTextures(M,We.colorTexture,We.depthStencilTexture),t.setRenderTarget(M))}let Qt=B[Ft];Qt===void 0&&(Qt=new Pn,Qt.layers.enable(Ft),Qt.viewport=new Se,B[Ft]=Qt),Qt.matrix.fromArray(ee.transform.matrix),Qt.matrix.decompose(Qt.position,Qt.quaternion,Qt.scale),Qt.projectionMatrix.fromArray(ee.projectionMatrix),Qt.projectionMatrixInverse.copy(Qt.projectionMatrix).invert(),Qt.viewport.set(xe.x,xe.y,xe.width,xe.height),Ft===0&&(Z.matrix.copy(Qt.matrix),Z.matrix.decompose(Z.position,Z.quaternion,Z.scale)),Nt===!0&&Z.cameras.push(Qt)}let lt=s.enabledFeatures;if(lt&&lt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){u=n.getBinding();let Ft=u.getDepthInformation(_t[0]);Ft&&Ft.isValid&&Ft.texture&&m.init(Ft,s.renderState)}if(lt&&lt.includes("camera-access")&&_){t.state.unbindTexture(),u=n.getBinding();for(let Ft=0;Ft<_t.length;Ft++){let ee=_t[Ft].camera;if(ee){let xe=g[ee];xe||(xe=new to,g[ee]=xe);let Qt=u.getCameraImage(ee);xe.sourceTexture=Qt}}}}for(let _t=0;_t<E.length;_t++){let Nt=T[_t],lt=E[_t];Nt!==null&&lt!==void 0&&lt.update(Nt,pt,c||a)}it&&it(et,pt),pt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:pt}),p=null}let kt=new v_;kt.setAnimationLoop(Rt),this.setAnimationLoop=function(et){it=et},this.dispose=function(){}}},xA=new re,P_=new Yt;P_.set(-1,0,0,0,1,0,0,0,1);function vA(i,t){function e(m,g){m.matrixAutoUpdate===!0&&m.updateMatrix(),g.value.copy(m.matrix)}function n(m,g){g.color.getRGB(m.fogColor.value,gd(i)),g.isFog?(m.fogNear.value=g.near,m.fogFar.value=g.far):g.isFogExp2&&(m.fogDensity.value=g.density)}function s(m,g,x,w,M){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(m,g):g.isMeshLambertMaterial?(r(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(m,g),u(m,g)):g.isMeshPhongMaterial?(r(m,g),h(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(m,g),f(m,g),g.isMeshPhysicalMaterial&&d(m,g,M)):g.isMeshMatcapMaterial?(r(m,g),p(m,g)):g.isMeshDepthMaterial?r(m,g):g.isMeshDistanceMaterial?(r(m,g),_(m,g)):g.isMeshNormalMaterial?r(m,g):g.isLineBasicMaterial?(a(m,g),g.isLineDashedMaterial&&o(m,g)):g.isPointsMaterial?l(m,g,x,w):g.isSpriteMaterial?c(m,g):g.isShadowMaterial?(m.color.value.copy(g.color),m.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(m,g){m.opacity.value=g.opacity,g.color&&m.diffuse.value.copy(g.color),g.emissive&&m.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(m.map.value=g.map,e(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.bumpMap&&(m.bumpMap.value=g.bumpMap,e(g.bumpMap,m.bumpMapTransform),m.bumpScale.value=g.bumpScale,g.side===Nn&&(m.bumpScale.value*=-1)),g.normalMap&&(m.normalMap.value=g.normalMap,e(g.normalMap,m.normalMapTransform),m.normalScale.value.copy(g.normalScale),g.side===Nn&&m.normalScale.value.negate()),g.displacementMap&&(m.displacementMap.value=g.displacementMap,e(g.displacementMap,m.displacementMapTransform),m.displacementScale.value=g.displacementScale,m.displacementBias.value=g.displacementBias),g.emissiveMap&&(m.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,m.emissiveMapTransform)),g.specularMap&&(m.specularMap.value=g.specularMap,e(g.specularMap,m.specularMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest);let x=t.get(g),w=x.envMap,M=x.envMapRotation;w&&(m.envMap.value=w,m.envMapRotation.value.setFromMatrix4(xA.makeRotationFromEuler(M)).transpose(),w.isCubeTexture&&w.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(P_),m.reflectivity.value=g.reflectivity,m.ior.value=g.ior,m.refractionRatio.value=g.refractionRatio),g.lightMap&&(m.lightMap.value=g.lightMap,m.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,m.lightMapTransform)),g.aoMap&&(m.aoMap.value=g.aoMap,m.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,m.aoMapTransform))}function a(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,g.map&&(m.map.value=g.map,e(g.map,m.mapTransform))}function o(m,g){m.dashSize.value=g.dashSize,m.totalSize.value=g.dashSize+g.gapSize,m.scale.value=g.scale}function l(m,g,x,w){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.size.value=g.size*x,m.scale.value=w*.5,g.map&&(m.map.value=g.map,e(g.map,m.uvTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function c(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.rotation.value=g.rotation,g.map&&(m.map.value=g.map,e(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function h(m,g){m.specular.value.copy(g.specular),m.shininess.value=Math.max(g.shininess,1e-4)}function u(m,g){g.gradientMap&&(m.gradientMap.value=g.gradientMap)}function f(m,g){m.metalness.value=g.metalness,g.metalnessMap&&(m.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,m.metalnessMapTransform)),m.roughness.value=g.roughness,g.roughnessMap&&(m.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,m.roughnessMapTransform)),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)}function d(m,g,x){m.ior.value=g.ior,g.diffuseRoughness>0&&(m.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),g.sheen>0&&(m.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),m.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(m.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,m.sheenColorMapTransform)),g.sheenRoughnessMap&&(m.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,m.sheenRoughnessMapTransform))),g.clearcoat>0&&(m.clearcoat.value=g.clearcoat,m.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(m.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,m.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(m.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===Nn&&m.clearcoatNormalScale.value.negate())),g.dispersion>0&&(m.dispersion.value=g.dispersion),g.retroreflectivity>0&&(m.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(m.iridescence.value=g.iridescence,m.iridescenceIOR.value=g.iridescenceIOR,m.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(m.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,m.iridescenceMapTransform)),g.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),g.transmission>0&&(m.transmission.value=g.transmission,m.transmissionSamplerMap.value=x.texture,m.transmissionSamplerSize.value.set(x.width,x.height),g.transmissionMap&&(m.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,m.transmissionMapTransform)),m.thickness.value=g.thickness,g.thicknessMap&&(m.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=g.attenuationDistance,m.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(m.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(m.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=g.specularIntensity,m.specularColor.value.copy(g.specularColor),g.specularColorMap&&(m.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,m.specularColorMapTransform)),g.specularIntensityMap&&(m.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,m.specularIntensityMapTransform))}function p(m,g){g.matcap&&(m.matcap.value=g.matcap)}function _(m,g){let x=t.get(g).light;m.referencePosition.value.setFromMatrixPosition(x.matrixWorld),m.nearDistance.value=x.shadow.camera.near,m.farDistance.value=x.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function MA(i,t,e,n){let s={},r={};function a(x,w){let M=w.program;n.uniformBlockBinding(x,M,s[x.id])}function o(x,w){let M=s[x.id];M===void 0&&(p(x),M=l(x),s[x.id]=M,x.addEventListener("dispose",m));let E=w.program;n.updateUBOMapping(x,E);let T=t.render.frame;r[x.id]!==T&&(c(x),r[x.id]=T)}function l(x){let w=i.createBuffer(),M=x.__size,E=x.usage;return i.bindBuffer(i.UNIFORM_BUFFER,w),i.bufferData(i.UNIFORM_BUFFER,M,E),i.bindBuffer(i.UNIFORM_BUFFER,null),w}function c(x){let w=s[x.id],M=x.uniforms,E=x.__cache;i.bindBuffer(i.UNIFORM_BUFFER,w);for(let T=0,y=M.length;T<y;T++){let A=M[T];if(Array.isArray(A))for(let F=0,N=A.length;F<N;F++)h(A[F],T,F,E);else h(A,T,0,E)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(x,w,M,E){if(f(x,w,M,E)===!0){let T=x.__offset,y=x.value;if(Array.isArray(y)){let A=0;for(let F=0;F<y.length;F++){let N=y[F],D=_(N,!0);u(N,x.__data,A),A+=D.storage/Float32Array.BYTES_PER_ELEMENT}}else u(y,x.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,T,x.__data)}}function u(x,w,M){typeof x=="number"||typeof x=="boolean"?w[M]=x:x.isMatrix3?(w[M]=x.elements[0],w[M+1]=x.elements[1],w[M+2]=x.elements[2],w[M+3]=0,w[M+4]=x.elements[3],w[M+5]=x.elements[4],w[M+6]=x.elements[5],w[M+7]=0,w[M+8]=x.elements[6],w[M+9]=x.elements[7],w[M+10]=x.elements[8],w[M+11]=0):ArrayBuffer.isView(x)?w.set(x.subarray(0,w.length-M),M):x.toArray(w,M)}function f(x,w,M,E){let T=x.value,y=w+"_"+M;if(Array.isArray(T)){E[y]===void 0&&(E[y]=[]);let A=E[y],F=!1;for(let N=0;N<T.length;N++)d(T[N],A,N)===!0&&(F=!0);return F}return d(T,E,y)}function d(x,w,M){if(w[M]===void 0)return typeof x=="number"||typeof x=="boolean"?w[M]=x:ArrayBuffer.isView(x)?w[M]=x.slice():w[M]=x.clone(),!0;{let E=w[M];if(typeof x=="number"||typeof x=="boolean"){if(E!==x)return w[M]=x,!0}else{if(ArrayBuffer.isView(x))return!0;if(E.equals(x)===!1)return E.copy(x),!0}}return!1}function p(x){let w=x.uniforms,M=0,E=16;for(let y=0,A=w.length;y<A;y++){let F=Array.isArray(w[y])?w[y]:[w[y]];for(let N=0,D=F.length;N<D;N++){let B=F[N],Z=Array.isArray(B.value)?B.value:[B.value],P=Array.isArray(w[y])||Array.isArray(B.value),$=M;for(let W=0,at=Z.length;W<at;W++){let X=Z[W],z=_(X,P),it=M%E,Rt=it%z.boundary,kt=it+Rt;M+=Rt,kt!==0&&E-kt<z.storage&&(M+=E-kt),W===0&&($=M),M+=z.storage}let Q=B.type==="int"?Int32Array:B.type==="uint"?Uint32Array:Float32Array;B.__data=new Q((M-$)/Float32Array.BYTES_PER_ELEMENT),B.__offset=$}}let T=M%E;return T>0&&(M+=E-T),x.__size=M,x.__cache={},this}function _(x,w){let M={boundary:0,storage:0};return typeof x=="number"||typeof x=="boolean"?(M.boundary=4,M.storage=4):x.isVector2?(M.boundary=8,M.storage=8):x.isVector3||x.isColor?(M.boundary=16,M.storage=12):x.isVector4?(M.boundary=16,M.storage=16):x.isMatrix3?(M.boundary=16,M.storage=48):x.isMatrix4?(M.boundary=16,M.storage=64):x.isTexture?Ut("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(x)?(M.boundary=16,M.storage=x.byteLength):Ut("WebGLRenderer: Unsupported uniform value type.",x),w===!0&&(M.boundary=16,M.storage=Math.ceil(M.storage/16)*16),M}function m(x){let w=x.target;w.removeEventListener("dispose",m),i.deleteBuffer(s[w.id]),delete s[w.id],delete r[w.id]}function g(){for(let x in s)i.deleteBuffer(s[x]);s={},r={}}return{bind:a,update:o,dispose:g}}var wA=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Ci=null;function bA(){return Ci===null&&(Ci=new Za(wA,16,16,ys,_i),Ci.name="DFG_LUT",Ci.minFilter=In,Ci.magFilter=In,Ci.wrapS=Si,Ci.wrapT=Si,Ci.generateMipmaps=!1,Ci.needsUpdate=!0),Ci}var ph=class{constructor(t={}){let{canvas:e=H0(),context:n=null,depth:s=!0,stencil:r=!1,alpha:a=!1,antialias:o=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:f=!1,outputBufferType:d=kn}=t;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=a;let _=d,m=new Set([Nc,Lc,Ic]),g=new Set([kn,gi,Yr,qs,Cc,Pc]),x=new Uint32Array(4),w=new Int32Array(4),M={textures:[],min:[],max:[],resolution:[]},E=null,T=null,y=[],A=[],F=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Ri,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let N=this,D=!1,B=null,Z=null,P=null,$=null;this._outputColorSpace=vn;let Q=0,W=0,at=null,X=-1,z=null,it=new Se,Rt=new Se,kt=null,et=new Jt(0),pt=0,_t=e.width,Nt=e.height,lt=1,Tt=null,oe=null,Ft=new Se(0,0,_t,Nt),ee=new Se(0,0,_t,Nt),xe=!1,Qt=new hs,We=new ac,Ue=!1,fn=!1,ve=new re,le=new k,Be=new Se,bn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},pn=!1;function ze(){return at===null?lt:1}let O=n;function Sn(S,L){return e.getContext(S,L)}let pe,Te,Mt,ke,Bt,Vt,C,b,V,ot,st,ut,yt,j,tt,ft,I,nt,J,mt,ht,dt,Dt;try{let S={alpha:!0,depth:s,stencil:r,antialias:o,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Ot,!1),e.addEventListener("webglcontextrestored",Zt,!1),e.addEventListener("webglcontextcreationerror",wt,!1),O===null){let L="webgl2";if(O=Sn(L,S),O===null)throw Sn(L)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Kt()}catch(S){throw e.removeEventListener("webglcontextlost",Ot,!1),e.removeEventListener("webglcontextrestored",Zt,!1),e.removeEventListener("webglcontextcreationerror",wt,!1),Wt("WebGLRenderer: "+S.message),S}function Kt(){pe=new D1(O),pe.init(),ht=new gA(O,pe),Te=new b1(O,pe,t,ht),Mt=new pA(O,pe),Te.reversedDepthBuffer&&f&&Mt.buffers.depth.setReversed(!0),Z=O.createFramebuffer(),P=O.createFramebuffer(),$=O.createFramebuffer(),ke=new F1(O),Bt=new tA,Vt=new mA(O,pe,Mt,Bt,Te,ht,ke),C=new N1(N),b=new kw(O),dt=new M1(O,b),V=new O1(O,b,ke,dt),ot=new k1(O,V,b,dt,ke),nt=new B1(O,Te,Vt),tt=new S1(Bt),st=new QE(N,C,pe,Te,dt,tt),ut=new vA(N,Bt),yt=new nA,j=new lA(pe),I=new v1(N,C,Mt,ot,p,l),ft=new dA(N,ot,Te),Dt=new MA(O,ke,Te,Mt),J=new w1(O,pe,ke),mt=new U1(O,pe,ke),ke.programs=st.programs,N.capabilities=Te,N.extensions=pe,N.properties=Bt,N.renderLists=yt,N.shadowMap=ft,N.state=Mt,N.info=ke}_!==kn&&(F=new G1(_,e.width,e.height,o,s,r));let ct=new Cd(N,O);this.xr=ct,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let S=pe.get("WEBGL_lose_context");S&&S.loseContext()},this.forceContextRestore=function(){let S=pe.get("WEBGL_lose_context");S&&S.restoreContext()},this.getPixelRatio=function(){return lt},this.setPixelRatio=function(S){S!==void 0&&(lt=S,this.setSize(_t,Nt,!1))},this.getSize=function(S){return S.set(_t,Nt)},this.setSize=function(S,L,q=!0){if(ct.isPresenting){Ut("WebGLRenderer: Can't change size while VR device is presenting.");return}_t=S,Nt=L,e.width=Math.floor(S*lt),e.height=Math.floor(L*lt),q===!0&&(e.style.width=S+"px",e.style.height=L+"px"),F!==null&&F.setSize(e.width,e.height),this.setViewport(0,0,S,L)},this.getDrawingBufferSize=function(S){return S.set(_t*lt,Nt*lt).floor()},this.setDrawingBufferSize=function(S,L,q){_t=S,Nt=L,lt=q,e.width=Math.floor(S*q),e.height=Math.floor(L*q),this.setViewport(0,0,S,L)},this.setEffects=function(S){if(_===kn){Wt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(S){for(let L=0;L<S.length;L++)if(S[L].isOutputPass===!0){Ut("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}F.setEffects(S||[])},this.getCurrentViewport=function(S){return S.copy(it)},this.getViewport=function(S){return S.copy(Ft)},this.setViewport=function(S,L,q,G){S.isVector4?Ft.set(S.x,S.y,S.z,S.w):Ft.set(S,L,q,G),Mt.viewport(it.copy(Ft).multiplyScalar(ze()).round())},this.getScissor=function(S){return S.copy(ee)},this.setScissor=function(S,L,q,G){S.isVector4?ee.set(S.x,S.y,S.z,S.w):ee.set(S,L,q,G),Mt.scissor(Rt.copy(ee).multiplyScalar(ze()).round())},this.getScissorTest=function(){return xe},this.setScissorTest=function(S){Mt.setScissorTest(xe=S)},this.setOpaqueSort=function(S){Tt=S},this.setTransparentSort=function(S){oe=S},this.getClearColor=function(S){return S.copy(I.getClearColor())},this.setClearColor=function(){I.setClearColor(...arguments)},this.getClearAlpha=function(){return I.getClearAlpha()},this.setClearAlpha=function(){I.setClearAlpha(...arguments)},this.clear=function(S=!0,L=!0,q=!0){let G=0;if(S){let H=!1;if(at!==null){let gt=at.texture.format;H=m.has(gt)}if(H){let gt=at.texture.type,Ct=g.has(gt),xt=I.getClearColor(),bt=I.getClearAlpha(),Lt=xt.r,qt=xt.g,ne=xt.b;Ct?(x[0]=Lt,x[1]=qt,x[2]=ne,x[3]=bt,O.clearBufferuiv(O.COLOR,0,x)):(w[0]=Lt,w[1]=qt,w[2]=ne,w[3]=bt,O.clearBufferiv(O.COLOR,0,w))}else G|=O.COLOR_BUFFER_BIT}L&&(G|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),q&&(G|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),G!==0&&O.clear(G)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(S){S.setRenderer(this),B=S},this.dispose=function(){e.removeEventListener("webglcontextlost",Ot,!1),e.removeEventListener("webglcontextrestored",Zt,!1),e.removeEventListener("webglcontextcreationerror",wt,!1),I.dispose(),yt.dispose(),j.dispose(),Vt.dispose(),Bt.dispose(),C.dispose(),ot.dispose(),V.dispose(),dt.dispose(),Dt.dispose(),st.dispose(),ct.dispose(),ct.removeEventListener("sessionstart",So),ct.removeEventListener("sessionend",Ks),Ii.stop()};function Ot(S){S.preventDefault(),ud("WebGLRenderer: Context Lost."),D=!0}function Zt(){ud("WebGLRenderer: Context Restored."),D=!1;let S=ke.autoReset,L=ft.enabled,q=ft.autoUpdate,G=ft.needsUpdate,H=ft.type;Kt(),ke.autoReset=S,ft.enabled=L,ft.autoUpdate=q,ft.needsUpdate=G,ft.type=H}function wt(S){Wt("WebGLRenderer: A WebGL context could not be created. Reason: ",S.statusMessage)}function me(S){let L=S.target;L.removeEventListener("dispose",me),Xe(L)}function Xe(S){yi(S),Bt.remove(S)}function yi(S){let L=Bt.get(S).programs;L!==void 0&&(L.forEach(function(q){st.releaseProgram(q)}),S.isShaderMaterial&&st.releaseShaderCache(S))}this.renderBufferDirect=function(S,L,q,G,H,gt){L===null&&(L=bn);let Ct=H.isMesh&&H.matrixWorld.determinantAffine()<0,xt=Ro(S,L,q,G,H);Mt.setMaterial(G,Ct);let bt=q.index,Lt=1;if(G.wireframe===!0){if(bt=V.getWireframeAttribute(q),bt===void 0)return;Lt=2}let qt=q.drawRange,ne=q.attributes.position,Pt=qt.start*Lt,ie=(qt.start+qt.count)*Lt;gt!==null&&(Pt=Math.max(Pt,gt.start*Lt),ie=Math.min(ie,(gt.start+gt.count)*Lt)),bt!==null?(Pt=Math.max(Pt,0),ie=Math.min(ie,bt.count)):ne!=null&&(Pt=Math.max(Pt,0),ie=Math.min(ie,ne.count));let Ne=ie-Pt;if(Ne<0||Ne===1/0)return;dt.setup(H,G,xt,q,bt);let fe,Me=J;if(bt!==null&&(fe=b.get(bt),Me=mt,Me.setIndex(fe)),H.isMesh)G.wireframe===!0?(Mt.setLineWidth(G.wireframeLinewidth*ze()),Me.setMode(O.LINES)):Me.setMode(O.TRIANGLES);else if(H.isLine){let sn=G.linewidth;sn===void 0&&(sn=1),Mt.setLineWidth(sn*ze()),H.isLineSegments?Me.setMode(O.LINES):H.isLineLoop?Me.setMode(O.LINE_LOOP):Me.setMode(O.LINE_STRIP)}else H.isPoints?Me.setMode(O.POINTS):H.isSprite&&Me.setMode(O.TRIANGLES);if(H.isBatchedMesh)if(pe.get("WEBGL_multi_draw"))Me.renderMultiDraw(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount);else{let sn=H._multiDrawStarts,It=H._multiDrawCounts,Je=H._multiDrawCount,ue=bt?b.get(bt).bytesPerElement:1,xi=Bt.get(G).currentProgram.getUniforms();for(let Ke=0;Ke<Je;Ke++)xi.setValue(O,"_gl_DrawID",Ke),Me.render(sn[Ke]/ue,It[Ke])}else if(H.isInstancedMesh)Me.renderInstances(Pt,Ne,H.count);else if(q.isInstancedBufferGeometry){let sn=q._maxInstanceCount!==void 0?q._maxInstanceCount:1/0,It=Math.min(q.instanceCount,sn);Me.renderInstances(Pt,Ne,It)}else Me.render(Pt,Ne)};function Kr(S,L,q,G){B!==null&&S.isNodeMaterial&&B.setObject(G,S),Ue===!0&&tt.setState(S,q,!1),S.transparent===!0&&S.side===Ti&&S.forceSinglePass===!1?(S.side=Nn,S.needsUpdate=!0,Ki(S,L,G),S.side=_s,S.needsUpdate=!0,Ki(S,L,G),S.side=Ti):Ki(S,L,G)}this.compile=function(S,L,q=null){q===null&&(q=S),B!==null&&B.renderStart(S,L,q),T=j.get(q),T.init(L),A.push(T),q.traverseVisible(function(H){H.isLight&&H.layers.test(L.layers)&&(T.pushLight(H),H.castShadow&&T.pushShadow(H))}),S!==q&&S.traverseVisible(function(H){H.isLight&&H.layers.test(L.layers)&&(T.pushLight(H),H.castShadow&&T.pushShadow(H))}),T.setupLights(),B!==null&&B.updateLights(T.state.lightsArray),fn=this.localClippingEnabled,Ue=tt.init(this.clippingPlanes,fn),Ue===!0&&tt.setGlobalState(this.clippingPlanes,L),B!==null&&ft.render(T.state.shadowsArray,q,L);let G=new Set;return S.traverse(function(H){if(!(H.isMesh||H.isPoints||H.isLine||H.isSprite))return;let gt=H.material;if(gt)if(Array.isArray(gt))for(let Ct=0;Ct<gt.length;Ct++){let xt=gt[Ct];Kr(xt,q,L,H),G.add(xt)}else Kr(gt,q,L,H),G.add(gt)}),T=A.pop(),B!==null&&B.renderEnd(),G},this.compileAsync=function(S,L,q=null){let G=this.compile(S,L,q);return new Promise(H=>{function gt(){if(G.forEach(function(Ct){let bt=Bt.get(Ct).currentProgram;(bt===void 0||bt.isReady())&&G.delete(Ct)}),G.size===0){H(S);return}setTimeout(gt,10)}pe.get("KHR_parallel_shader_compile")!==null?gt():setTimeout(gt,10)})};let xs=null;function Js(S){xs&&xs(S)}function So(){Ii.stop()}function Ks(){Ii.start()}let Ii=new v_;Ii.setAnimationLoop(Js),typeof self<"u"&&Ii.setContext(self),this.setAnimationLoop=function(S){xs=S,ct.setAnimationLoop(S),S===null?Ii.stop():Ii.start()},ct.addEventListener("sessionstart",So),ct.addEventListener("sessionend",Ks),this.render=function(S,L){if(L!==void 0&&L.isCamera!==!0){Wt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(D===!0)return;B!==null&&B.renderStart(S,L);let q=ct.enabled===!0&&ct.isPresenting===!0,G=F!==null&&(at===null||q)&&F.begin(N,at);if(S.matrixWorldAutoUpdate===!0&&S.updateMatrixWorld(),L.parent===null&&L.matrixWorldAutoUpdate===!0&&L.updateMatrixWorld(),ct.enabled===!0&&ct.isPresenting===!0&&(F===null||F.isCompositing()===!1)&&(ct.cameraAutoUpdate===!0&&ct.updateCamera(L),L=ct.getCamera()),S.isScene===!0&&S.onBeforeRender(N,S,L,at),T=j.get(S,A.length),T.init(L),T.state.textureUnits=Vt.getTextureUnits(),A.push(T),ve.multiplyMatrices(L.projectionMatrix,L.matrixWorldInverse),L.isArrayCamera?We.setFromArrayCamera(L):Qt.setFromProjectionMatrix(ve,ii,L.reversedDepth),fn=this.localClippingEnabled,Ue=tt.init(this.clippingPlanes,fn),E=yt.get(S,y.length),E.init(),y.push(E),this.info.render.frame++,ct.enabled===!0&&ct.isPresenting===!0){let Ct=N.xr.getDepthSensingMesh();Ct!==null&&jr(Ct,L,-1/0,N.sortObjects)}jr(S,L,0,N.sortObjects),E.finish(),B!==null&&B.updateLights(T.state.lightsArray),N.sortObjects===!0&&E.sort(Tt,oe),pn=ct.enabled===!1||ct.isPresenting===!1||ct.hasDepthSensing()===!1,pn&&I.addToRenderList(E,S),this.info.autoReset===!0&&this.info.reset(),Ue===!0&&tt.beginShadows();let H=T.state.shadowsArray;if(ft.render(H,S,L),Ue===!0&&tt.endShadows(),(G&&F.hasRenderPass())===!1){let Ct=E.opaque,xt=E.transmissive;if(T.setupLights(),L.isArrayCamera){let bt=L.cameras;if(xt.length>0)for(let Lt=0,qt=bt.length;Lt<qt;Lt++){let ne=bt[Lt];Ao(Ct,xt,S,ne)}pn&&I.render(S);for(let Lt=0,qt=bt.length;Lt<qt;Lt++){let ne=bt[Lt];Eo(E,S,ne,ne.viewport)}}else xt.length>0&&Ao(Ct,xt,S,L),pn&&I.render(S),Eo(E,S,L)}at!==null&&W===0&&(Vt.updateMultisampleRenderTarget(at),Vt.updateRenderTargetMipmap(at)),G&&F.end(N),S.isScene===!0&&S.onAfterRender(N,S,L),dt.resetDefaultState(),X=-1,z=null,A.pop(),A.length>0?(T=A[A.length-1],Vt.setTextureUnits(T.state.textureUnits),Ue===!0&&tt.setGlobalState(N.clippingPlanes,T.state.camera)):T=null,y.pop(),y.length>0?E=y[y.length-1]:E=null,B!==null&&B.renderEnd()};function jr(S,L,q,G){if(S.visible===!1)return;if(S.layers.test(L.layers)){if(S.isGroup)q=S.renderOrder;else if(S.isLOD)S.autoUpdate===!0&&S.update(L);else if(S.isLight)T.pushLight(S),S.castShadow&&T.pushShadow(S);else if(S.isSprite){let Ct=L.isArrayCamera?We:Qt;if(!S.frustumCulled||S.intersectsFrustum(Ct)){G&&Be.setFromMatrixPosition(S.matrixWorld).applyMatrix4(ve);let xt=ot.update(S),bt=S.material;bt.visible&&E.push(S,xt,bt,q,Be.z,null,L)}}else if(S.isMesh||S.isLine||S.isPoints){let Ct=L.isArrayCamera?We:Qt;if(!S.frustumCulled||S.intersectsFrustum(Ct)){let xt=ot.update(S),bt=S.material;if(G&&(S.boundingSphere!==void 0?(S.boundingSphere===null&&S.computeBoundingSphere(),Be.copy(S.boundingSphere.center)):(xt.boundingSphere===null&&xt.computeBoundingSphere(),Be.copy(xt.boundingSphere.center)),Be.applyMatrix4(S.matrixWorld).applyMatrix4(ve)),Array.isArray(bt)){let Lt=xt.groups;for(let qt=0,ne=Lt.length;qt<ne;qt++){let Pt=Lt[qt],ie=bt[Pt.materialIndex];ie&&ie.visible&&E.push(S,xt,ie,q,Be.z,Pt,L)}}else bt.visible&&E.push(S,xt,bt,q,Be.z,null,L)}}}let gt=S.children;for(let Ct=0,xt=gt.length;Ct<xt;Ct++)jr(gt[Ct],L,q,G)}function Eo(S,L,q,G){let{opaque:H,transmissive:gt,transparent:Ct}=S;T.setupLightsView(q),Ue===!0&&tt.setGlobalState(N.clippingPlanes,q),G&&Mt.viewport(it.copy(G)),H.length>0&&js(H,L,q),gt.length>0&&js(gt,L,q),Ct.length>0&&js(Ct,L,q),Mt.buffers.depth.setTest(!0),Mt.buffers.depth.setMask(!0),Mt.buffers.color.setMask(!0),Mt.setPolygonOffset(!1)}function Ao(S,L,q,G){if((q.isScene===!0?q.overrideMaterial:null)!==null)return;if(T.state.transmissionRenderTarget[G.id]===void 0){let Pt=pe.has("EXT_color_buffer_half_float")||pe.has("EXT_color_buffer_float");T.state.transmissionRenderTarget[G.id]=new Yn(1,1,{generateMipmaps:!0,type:Pt?_i:kn,minFilter:Yi,samples:Math.max(4,Te.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:he.workingColorSpace})}let gt=T.state.transmissionRenderTarget[G.id],Ct=G.viewport||it;gt.setSize(Ct.z*N.transmissionResolutionScale,Ct.w*N.transmissionResolutionScale);let xt=N.getRenderTarget(),bt=N.getActiveCubeFace(),Lt=N.getActiveMipmapLevel();N.setRenderTarget(gt),N.getClearColor(et),pt=N.getClearAlpha(),pt<1&&N.setClearColor(16777215,.5),N.clear(),pn&&I.render(q);let qt=N.toneMapping;N.toneMapping=Ri;let ne=G.viewport;if(G.viewport!==void 0&&(G.viewport=void 0),T.setupLightsView(G),Ue===!0&&tt.setGlobalState(N.clippingPlanes,G),js(S,q,G),Vt.updateMultisampleRenderTarget(gt),Vt.updateRenderTargetMipmap(gt),pe.has("WEBGL_multisampled_render_to_texture")===!1){let Pt=!1;for(let ie=0,Ne=L.length;ie<Ne;ie++){let fe=L[ie],{object:Me,geometry:sn,material:It,group:Je}=fe;if(It.side===Ti&&Me.layers.test(G.layers)){let ue=It.side;It.side=Nn,It.needsUpdate=!0,Qr(Me,q,G,sn,It,Je),It.side=ue,It.needsUpdate=!0,Pt=!0}}Pt===!0&&(Vt.updateMultisampleRenderTarget(gt),Vt.updateRenderTargetMipmap(gt))}N.setRenderTarget(xt,bt,Lt),N.setClearColor(et,pt),ne!==void 0&&(G.viewport=ne),N.toneMapping=qt}function js(S,L,q){let G=L.isScene===!0?L.overrideMaterial:null;for(let H=0,gt=S.length;H<gt;H++){let Ct=S[H],{object:xt,geometry:bt,group:Lt}=Ct,qt=Ct.material;qt.allowOverride===!0&&G!==null&&(qt=G),xt.layers.test(q.layers)&&Qr(xt,L,q,bt,qt,Lt)}}function Qr(S,L,q,G,H,gt){B!==null&&H.isNodeMaterial&&B.setObject(S,H),S.onBeforeRender(N,L,q,G,H,gt),S.modelViewMatrix.multiplyMatrices(q.matrixWorldInverse,S.matrixWorld),S.normalMatrix.getNormalMatrix(S.modelViewMatrix),H.onBeforeRender(N,L,q,G,S,gt),H.transparent===!0&&H.side===Ti&&H.forceSinglePass===!1?(H.side=Nn,H.needsUpdate=!0,N.renderBufferDirect(q,L,G,H,S,gt),H.side=_s,H.needsUpdate=!0,N.renderBufferDirect(q,L,G,H,S,gt),H.side=Ti):N.renderBufferDirect(q,L,G,H,S,gt),S.onAfterRender(N,L,q,G,H,gt)}function ta(S){let L=0;for(let q of S)q.texture!==null&&L++;return L}function Ki(S,L,q){L.isScene!==!0&&(L=bn);let G=Bt.get(S),H=T.state.lights,gt=T.state.shadowsArray,Ct=H.state.version,xt=st.getParameters(S,H.state,gt,L,q,T.state.lightProbeGridArray),bt=st.getProgramCacheKey(xt),Lt=G.programs;G.environment=S.isMeshStandardMaterial||S.isMeshLambertMaterial||S.isMeshPhongMaterial?L.environment:null,G.fog=L.fog;let qt=S.isMeshStandardMaterial||S.isMeshLambertMaterial&&!S.envMap||S.isMeshPhongMaterial&&!S.envMap;G.envMap=C.get(S.envMap||G.environment,qt),G.envMapRotation=G.environment!==null&&S.envMap===null?L.environmentRotation:S.envMapRotation,Lt===void 0&&(S.addEventListener("dispose",me),Lt=new Map,G.programs=Lt,G.programVariants=new Map);let ne=Lt.get(bt);if(ne!==void 0){if(G.currentProgram===ne&&G.lightsStateVersion===Ct)return ea(S,xt),ne}else xt.uniforms=st.getUniforms(S),B!==null&&S.isNodeMaterial&&B.build(S,q,xt),S.onBeforeCompile(xt,N),ne=st.acquireProgram(xt,bt),Lt.set(bt,ne),G.uniforms=xt.uniforms;let Pt=G.uniforms;return(!S.isShaderMaterial&&!S.isRawShaderMaterial||S.clipping===!0)&&(Pt.clippingPlanes=tt.uniform),ea(S,xt),G.needsLights=bh(S),G.lightsStateVersion=Ct,G.needsLights&&(Pt.ambientLightColor.value=H.state.ambient,Pt.lightProbe.value=H.state.probe,Pt.sunLights.value=H.state.sun,Pt.sunLightShadows.value=H.state.sunShadow,Pt.directionalLights.value=H.state.directional,Pt.directionalLightShadows.value=H.state.directionalShadow,Pt.spotLights.value=H.state.spot,Pt.spotLightShadows.value=H.state.spotShadow,Pt.rectAreaLights.value=H.state.rectArea,Pt.ltc_1.value=H.state.rectAreaLTC1,Pt.ltc_2.value=H.state.rectAreaLTC2,Pt.pointLights.value=H.state.point,Pt.pointLightShadows.value=H.state.pointShadow,Pt.hemisphereLights.value=H.state.hemi,Pt.sunShadowMatrix.value=H.state.sunShadowMatrix,Pt.sunShadowCascade.value=H.state.sunShadowCascade,Pt.directionalShadowMatrix.value=H.state.directionalShadowMatrix,Pt.spotLightMatrix.value=H.state.spotLightMatrix,Pt.spotLightMap.value=H.state.spotLightMap,Pt.pointShadowMatrix.value=H.state.pointShadowMatrix),G.numLightProbeGrids=ta(T.state.lightProbeGridArray),G.currentProgram=ne,G.uniformsList=null,ne}function wh(S,L,q,G,H){let gt=Bt.get(S),Ct=gt.currentProgram.id+","+G+","+H,xt=gt.programVariants.get(Ct);return xt===void 0?(xt=Ki(S,L,q),gt.programVariants.set(Ct,xt)):(gt.currentProgram=xt,gt.uniformsList=null,gt.outputColorSpace=G,gt.toneMapping=H),xt}function To(S){if(S.uniformsList===null){let L=S.currentProgram.getUniforms();S.uniformsList=Zr.seqWithValue(L.seq,S.uniforms)}return S.uniformsList}function ea(S,L){let q=Bt.get(S);q.outputColorSpace=L.outputColorSpace,q.batching=L.batching,q.batchingColor=L.batchingColor,q.instancing=L.instancing,q.instancingColor=L.instancingColor,q.instancingMorph=L.instancingMorph,q.skinning=L.skinning,q.morphTargets=L.morphTargets,q.morphNormals=L.morphNormals,q.morphColors=L.morphColors,q.morphTargetsCount=L.morphTargetsCount,q.numClippingPlanes=L.numClippingPlanes,q.numIntersection=L.numClipIntersection,q.vertexAlphas=L.vertexAlphas,q.vertexTangents=L.vertexTangents,q.toneMapping=L.toneMapping}function Ro(S,L,q,G,H){L.isScene!==!0&&(L=bn),Vt.resetTextureUnits();let gt=L.fog,Ct=G.isMeshStandardMaterial||G.isMeshLambertMaterial||G.isMeshPhongMaterial?L.environment:null,xt=at===null?N.outputColorSpace:at.isXRRenderTarget===!0?at.texture.colorSpace:he.workingColorSpace,bt=G.isMeshStandardMaterial||G.isMeshLambertMaterial&&!G.envMap||G.isMeshPhongMaterial&&!G.envMap,Lt=C.get(G.envMap||Ct,bt),qt=G.vertexColors===!0&&!!q.attributes.color&&q.attributes.color.itemSize===4,ne=!!q.attributes.tangent&&(!!G.normalMap||G.anisotropy>0),Pt=!!q.morphAttributes.position,ie=!!q.morphAttributes.normal,Ne=!!q.morphAttributes.color,fe=Ri;G.toneMapped&&(at===null||at.isXRRenderTarget===!0)&&(fe=N.toneMapping);let Me=q.morphAttributes.position||q.morphAttributes.normal||q.morphAttributes.color,sn=Me!==void 0?Me.length:0,It=Bt.get(G),Je=T.state.lights;if(Ue===!0&&(fn===!0||S!==z)){let Ie=S===z&&G.id===X;tt.setState(G,S,Ie)}let ue=!1,xi=!1;G.version===It.__version?It.needsLights&&It.lightsStateVersion!==Je.state.version||H.isBatchedMesh&&It.batching===!1||!H.isBatchedMesh&&It.batching===!0||H.isBatchedMesh&&It.batchingColor===!0&&H._colorsTexture===null||H.isBatchedMesh&&It.batchingColor===!1&&H._colorsTexture!==null||H.isInstancedMesh&&It.instancing===!1||!H.isInstancedMesh&&It.instancing===!0||H.isSkinnedMesh&&It.skinning===!1||!H.isSkinnedMesh&&It.skinning===!0||H.isInstancedMesh&&It.instancingColor===!0&&H.instanceColor===null||H.isInstancedMesh&&It.instancingColor===!1&&H.instanceColor!==null||H.isInstancedMesh&&It.instancingMorph===!0&&H.morphTexture===null||H.isInstancedMesh&&It.instancingMorph===!1&&H.morphTexture!==null||It.envMap!==Lt||G.fog===!0&&It.fog!==gt||It.numClippingPlanes!==void 0&&(It.numClippingPlanes!==tt.numPlanes||It.numIntersection!==tt.numIntersection)||It.vertexAlphas!==qt||It.vertexTangents!==ne||It.morphTargets!==Pt||It.morphNormals!==ie||It.morphColors!==Ne||It.morphTargetsCount!==sn||It.numLightProbeGrids!==ta(T.state.lightProbeGridArray)?ue=!0:(It.outputColorSpace!==xt||It.toneMapping!==fe)&&(xi=!0):(ue=!0,It.__version=G.version);let Ke=It.currentProgram;(ue===!0||xi===!0)&&(Ke=xi===!0?wh(G,L,H,xt,fe):Ki(G,L,H),B&&G.isNodeMaterial&&B.onUpdateProgram(G,Ke,It));let Ms=!1,ai=!1,vi=!1,ce=Ke.getUniforms(),$e=It.uniforms;if(Mt.useProgram(Ke.program)&&(Ms=!0,ai=!0,vi=!0),G.id!==X&&(X=G.id,ai=!0),Ms||z!==S){Mt.buffers.depth.getReversed()&&S.reversedDepth!==!0&&(S._reversedDepth=!0,S.updateProjectionMatrix()),ce.setValue(O,"projectionMatrix",S.projectionMatrix),ce.setValue(O,"viewMatrix",S.matrixWorldInverse);let qe=ce.map.cameraPosition;qe!==void 0&&qe.setValue(O,le.setFromMatrixPosition(S.matrixWorld)),Te.logarithmicDepthBuffer&&ce.setValue(O,"logDepthBufFC",2/(Math.log(S.far+1)/Math.LN2)),(G.isMeshPhongMaterial||G.isMeshToonMaterial||G.isMeshLambertMaterial||G.isMeshBasicMaterial||G.isMeshStandardMaterial||G.isShaderMaterial)&&ce.setValue(O,"isOrthographic",S.isOrthographicCamera===!0),z!==S&&(z=S,ai=!0,vi=!0)}if(It.needsLights&&(Je.state.sunShadowMap.length>0&&ce.setValue(O,"sunShadowMap",Je.state.sunShadowMap,Vt),Je.state.directionalShadowMap.length>0&&ce.setValue(O,"directionalShadowMap",Je.state.directionalShadowMap,Vt),Je.state.spotShadowMap.length>0&&ce.setValue(O,"spotShadowMap",Je.state.spotShadowMap,Vt),Je.state.pointShadowMap.length>0&&ce.setValue(O,"pointShadowMap",Je.state.pointShadowMap,Vt)),H.isSkinnedMesh){ce.setOptional(O,H,"bindMatrix"),ce.setOptional(O,H,"bindMatrixInverse");let Ie=H.skeleton;Ie&&(Ie.boneTexture===null&&Ie.computeBoneTexture(),ce.setValue(O,"boneTexture",Ie.boneTexture,Vt))}H.isBatchedMesh&&(ce.setOptional(O,H,"batchingTexture"),ce.setValue(O,"batchingTexture",H._matricesTexture,Vt),ce.setOptional(O,H,"batchingIdTexture"),ce.setValue(O,"batchingIdTexture",H._indirectTexture,Vt),ce.setOptional(O,H,"batchingColorTexture"),H._colorsTexture!==null&&ce.setValue(O,"batchingColorTexture",H._colorsTexture,Vt));let Gn=q.morphAttributes;if((Gn.position!==void 0||Gn.normal!==void 0||Gn.color!==void 0)&&nt.update(H,q,Ke),(ai||It.receiveShadow!==H.receiveShadow)&&(It.receiveShadow=H.receiveShadow,ce.setValue(O,"receiveShadow",H.receiveShadow)),(G.isMeshStandardMaterial||G.isMeshLambertMaterial||G.isMeshPhongMaterial)&&G.envMap===null&&L.environment!==null&&($e.envMapIntensity.value=L.environmentIntensity),$e.dfgLUT!==void 0&&($e.dfgLUT.value=bA()),ai){if(ce.setValue(O,"toneMappingExposure",N.toneMappingExposure),It.needsLights&&vs($e,vi),gt&&G.fog===!0&&ut.refreshFogUniforms($e,gt),ut.refreshMaterialUniforms($e,G,lt,Nt,T.state.transmissionRenderTarget[S.id]),It.needsLights&&It.numLightProbeGrids>0){let Ie=M,qe=0;for(let Jn of T.state.lightProbeGridArray)Jn.texture!==null&&(Ie.textures[qe]=Jn.texture,Ie.min[qe]=Jn.boundingBox.min,Ie.max[qe]=Jn.boundingBox.max,Ie.resolution[qe]=Jn.resolution,qe++);for(let Jn in Ie)Ie[Jn].length=qe;$e.probesSH.value=Ie.textures,$e.probesMin.value=Ie.min,$e.probesMax.value=Ie.max,$e.probesResolution.value=Ie.resolution}Zr.upload(O,To(It),$e,Vt)}if(G.isShaderMaterial&&G.uniformsNeedUpdate===!0&&(Zr.upload(O,To(It),$e,Vt),G.uniformsNeedUpdate=!1),G.isSpriteMaterial&&ce.setValue(O,"center",H.center),ce.setValue(O,"modelViewMatrix",H.modelViewMatrix),ce.setValue(O,"normalMatrix",H.normalMatrix),ce.setValue(O,"modelMatrix",H.matrixWorld),G.uniformsGroups!==void 0){let Ie=G.uniformsGroups;for(let qe=0,Jn=Ie.length;qe<Jn;qe++){let Co=Ie[qe];Dt.update(Co,Ke),Dt.bind(Co,Ke)}}return Ke}function vs(S,L){S.ambientLightColor.needsUpdate=L,S.lightProbe.needsUpdate=L,S.sunLights.needsUpdate=L,S.sunLightShadows.needsUpdate=L,S.directionalLights.needsUpdate=L,S.directionalLightShadows.needsUpdate=L,S.pointLights.needsUpdate=L,S.pointLightShadows.needsUpdate=L,S.spotLights.needsUpdate=L,S.spotLightShadows.needsUpdate=L,S.rectAreaLights.needsUpdate=L,S.hemisphereLights.needsUpdate=L}function bh(S){return S.isMeshLambertMaterial||S.isMeshToonMaterial||S.isMeshPhongMaterial||S.isMeshStandardMaterial||S.isShadowMaterial||S.isShaderMaterial&&S.lights===!0}this.getActiveCubeFace=function(){return Q},this.getActiveMipmapLevel=function(){return W},this.getRenderTarget=function(){return at},this.setRenderTargetTextures=function(S,L,q){let G=Bt.get(S);G.__autoAllocateDepthBuffer=S.resolveDepthBuffer===!1,G.__autoAllocateDepthBuffer===!1&&(G.__useRenderToTexture=!1),Bt.get(S.texture).__webglTexture=L,Bt.get(S.depthTexture).__webglTexture=G.__autoAllocateDepthBuffer?void 0:q,G.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(S,L){let q=Bt.get(S);q.__webglFramebuffer=L,q.__useDefaultFramebuffer=L===void 0},this.setRenderTarget=function(S,L=0,q=0){at=S,Q=L,W=q;let G=null,H=!1,gt=!1;if(S){let xt=Bt.get(S);if(xt.__useDefaultFramebuffer!==void 0){Mt.bindFramebuffer(O.FRAMEBUFFER,xt.__webglFramebuffer),it.copy(S.viewport),Rt.copy(S.scissor),kt=S.scissorTest,Mt.viewport(it),Mt.scissor(Rt),Mt.setScissorTest(kt),X=-1;return}else if(xt.__webglFramebuffer===void 0)Vt.setupRenderTarget(S);else if(xt.__hasExternalTextures)Vt.rebindTextures(S,Bt.get(S.texture).__webglTexture,Bt.get(S.depthTexture).__webglTexture);else if(S.depthBuffer){let qt=S.depthTexture;if(xt.__boundDepthTexture!==qt){if(qt!==null&&Bt.has(qt)&&(S.width!==qt.image.width||S.height!==qt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Vt.setupDepthRenderbuffer(S)}}let bt=S.texture;(bt.isData3DTexture||bt.isDataArrayTexture||bt.isCompressedArrayTexture)&&(gt=!0);let Lt=Bt.get(S).__webglFramebuffer;S.isWebGLCubeRenderTarget?(Array.isArray(Lt[L])?G=Lt[L][q]:G=Lt[L],H=!0):S.samples>0&&Vt.useMultisampledRTT(S)===!1?G=Bt.get(S).__webglMultisampledFramebuffer:Array.isArray(Lt)?G=Lt[q]:G=Lt,it.copy(S.viewport),Rt.copy(S.scissor),kt=S.scissorTest}else it.copy(Ft).multiplyScalar(lt).floor(),Rt.copy(ee).multiplyScalar(lt).floor(),kt=xe;if(q!==0&&(G=Z),Mt.bindFramebuffer(O.FRAMEBUFFER,G)&&Mt.drawBuffers(S,G),Mt.viewport(it),Mt.scissor(Rt),Mt.setScissorTest(kt),H){let xt=Bt.get(S.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+L,xt.__webglTexture,q)}else if(gt){let xt=L;for(let bt=0;bt<S.textures.length;bt++){let Lt=Bt.get(S.textures[bt]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+bt,Lt.__webglTexture,q,xt)}}else if(S!==null&&q!==0){let xt=Bt.get(S.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,xt.__webglTexture,q)}X=-1};function na(S){let L=Bt.get(S);return(L.__readFormat!==S.format||L.__readType!==S.type)&&(L.__readFormat=S.format,L.__readType=S.type,L.__formatReadable=Te.textureFormatReadable(S.format),L.__typeReadable=Te.textureTypeReadable(S.type)),L}this.readRenderTargetPixels=function(S,L,q,G,H,gt,Ct,xt=0){if(!(S&&S.isWebGLRenderTarget)){Wt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let bt=Bt.get(S).__webglFramebuffer;if(S.isWebGLCubeRenderTarget&&Ct!==void 0&&(bt=bt[Ct],Array.isArray(bt)&&(bt=bt[0])),bt){Mt.bindFramebuffer(O.FRAMEBUFFER,bt);try{let Lt=S.textures[xt],qt=Lt.format,ne=Lt.type;S.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+xt);let Pt=na(Lt);if(Pt.__formatReadable===!1){Wt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Pt.__typeReadable===!1){Wt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}L>=0&&L<=S.width-G&&q>=0&&q<=S.height-H&&O.readPixels(L,q,G,H,ht.convert(qt),ht.convert(ne),gt)}finally{let Lt=at!==null?Bt.get(at).__webglFramebuffer:null;Mt.bindFramebuffer(O.FRAMEBUFFER,Lt)}}},this.readRenderTargetPixelsAsync=async function(S,L,q,G,H,gt,Ct,xt=0){if(!(S&&S.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let bt=Bt.get(S).__webglFramebuffer;if(S.isWebGLCubeRenderTarget&&Ct!==void 0&&(bt=bt[Ct],Array.isArray(bt)&&(bt=bt[0])),bt)if(L>=0&&L<=S.width-G&&q>=0&&q<=S.height-H){Mt.bindFramebuffer(O.FRAMEBUFFER,bt);let Lt=S.textures[xt],qt=Lt.format,ne=Lt.type;S.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+xt);let Pt=na(Lt);if(Pt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Pt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let ie=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,ie),O.bufferData(O.PIXEL_PACK_BUFFER,gt.byteLength,O.STREAM_READ),O.readPixels(L,q,G,H,ht.convert(qt),ht.convert(ne),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let Ne=at!==null?Bt.get(at).__webglFramebuffer:null;Mt.bindFramebuffer(O.FRAMEBUFFER,Ne);let fe=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await X0(O,fe,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,ie),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,gt),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(ie),O.deleteSync(fe),gt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(S,L=null,q=0){let G=Math.pow(2,-q),H=Math.floor(S.image.width*G),gt=Math.floor(S.image.height*G),Ct=L!==null?L.x:0,xt=L!==null?L.y:0;Vt.setTexture2D(S,0),O.copyTexSubImage2D(O.TEXTURE_2D,q,0,0,Ct,xt,H,gt),Mt.unbindTexture()},this.copyTextureToTexture=function(S,L,q=null,G=null,H=0,gt=0){let Ct,xt,bt,Lt,qt,ne,Pt,ie,Ne,fe=S.isCompressedTexture?S.mipmaps[gt]:S.image;if(q!==null)Ct=q.max.x-q.min.x,xt=q.max.y-q.min.y,bt=q.isBox3?q.max.z-q.min.z:1,Lt=q.min.x,qt=q.min.y,ne=q.isBox3?q.min.z:0;else{let ce=Math.pow(2,-H);Ct=Math.floor(fe.width*ce),xt=Math.floor(fe.height*ce),S.isDataArrayTexture?bt=fe.depth:S.isData3DTexture?bt=Math.floor(fe.depth*ce):bt=1,Lt=0,qt=0,ne=0}G!==null?(Pt=G.x,ie=G.y,Ne=G.z):(Pt=0,ie=0,Ne=0);let Me=ht.convert(L.format),sn=ht.convert(L.type),It;L.isData3DTexture?(Vt.setTexture3D(L,0),It=O.TEXTURE_3D):L.isDataArrayTexture||L.isCompressedArrayTexture?(Vt.setTexture2DArray(L,0),It=O.TEXTURE_2D_ARRAY):(Vt.setTexture2D(L,0),It=O.TEXTURE_2D),Mt.activeTexture(O.TEXTURE0),Mt.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,L.flipY),Mt.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,L.premultiplyAlpha),Mt.pixelStorei(O.UNPACK_ALIGNMENT,L.unpackAlignment);let Je=Mt.getParameter(O.UNPACK_ROW_LENGTH),ue=Mt.getParameter(O.UNPACK_IMAGE_HEIGHT),xi=Mt.getParameter(O.UNPACK_SKIP_PIXELS),Ke=Mt.getParameter(O.UNPACK_SKIP_ROWS),Ms=Mt.getParameter(O.UNPACK_SKIP_IMAGES);Mt.pixelStorei(O.UNPACK_ROW_LENGTH,fe.width),Mt.pixelStorei(O.UNPACK_IMAGE_HEIGHT,fe.height),Mt.pixelStorei(O.UNPACK_SKIP_PIXELS,Lt),Mt.pixelStorei(O.UNPACK_SKIP_ROWS,qt),Mt.pixelStorei(O.UNPACK_SKIP_IMAGES,ne);let ai=S.isDataArrayTexture||S.isData3DTexture,vi=L.isDataArrayTexture||L.isData3DTexture;if(S.isDepthTexture){let ce=Bt.get(S),$e=Bt.get(L),Gn=Bt.get(ce.__renderTarget),Ie=Bt.get($e.__renderTarget);Mt.bindFramebuffer(O.READ_FRAMEBUFFER,Gn.__webglFramebuffer),Mt.bindFramebuffer(O.DRAW_FRAMEBUFFER,Ie.__webglFramebuffer);for(let qe=0;qe<bt;qe++)ai&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Bt.get(S).__webglTexture,H,ne+qe),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Bt.get(L).__webglTexture,gt,Ne+qe)),O.blitFramebuffer(Lt,qt,Lt+Ct,qt+xt,Pt,ie,Pt+Ct,ie+xt,O.DEPTH_BUFFER_BIT,O.NEAREST);Mt.bindFramebuffer(O.READ_FRAMEBUFFER,null),Mt.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if(H!==0||S.isRenderTargetTexture||Bt.has(S)){let ce=Bt.get(S),$e=Bt.get(L);Mt.bindFramebuffer(O.READ_FRAMEBUFFER,P),Mt.bindFramebuffer(O.DRAW_FRAMEBUFFER,$);for(let Gn=0;Gn<bt;Gn++)ai?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,ce.__webglTexture,H,ne+Gn):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,ce.__webglTexture,H),vi?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,$e.__webglTexture,gt,Ne+Gn):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,$e.__webglTexture,gt),H!==0?O.blitFramebuffer(Lt,qt,Lt+Ct,qt+xt,Pt,ie,Pt+Ct,ie+xt,O.COLOR_BUFFER_BIT,O.NEAREST):vi?O.copyTexSubImage3D(It,gt,Pt,ie,Ne+Gn,Lt,qt,Ct,xt):O.copyTexSubImage2D(It,gt,Pt,ie,Lt,qt,Ct,xt);Mt.bindFramebuffer(O.READ_FRAMEBUFFER,null),Mt.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else vi?S.isDataTexture||S.isData3DTexture?O.texSubImage3D(It,gt,Pt,ie,Ne,Ct,xt,bt,Me,sn,fe.data):L.isCompressedArrayTexture?O.compressedTexSubImage3D(It,gt,Pt,ie,Ne,Ct,xt,bt,Me,fe.data):O.texSubImage3D(It,gt,Pt,ie,Ne,Ct,xt,bt,Me,sn,fe):S.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,gt,Pt,ie,Ct,xt,Me,sn,fe.data):S.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,gt,Pt,ie,fe.width,fe.height,Me,fe.data):O.texSubImage2D(O.TEXTURE_2D,gt,Pt,ie,Ct,xt,Me,sn,fe);Mt.pixelStorei(O.UNPACK_ROW_LENGTH,Je),Mt.pixelStorei(O.UNPACK_IMAGE_HEIGHT,ue),Mt.pixelStorei(O.UNPACK_SKIP_PIXELS,xi),Mt.pixelStorei(O.UNPACK_SKIP_ROWS,Ke),Mt.pixelStorei(O.UNPACK_SKIP_IMAGES,Ms),gt===0&&L.generateMipmaps===!0&&L.mipmapsAutoUpdate===!0&&O.generateMipmap(It),Mt.unbindTexture()},this.initRenderTarget=function(S){Bt.get(S).__webglFramebuffer===void 0&&Vt.setupRenderTarget(S)},this.initTexture=function(S){S.isCubeTexture?Vt.setTextureCube(S,0):S.isData3DTexture?Vt.setTexture3D(S,0):S.isDataArrayTexture||S.isCompressedArrayTexture?Vt.setTexture2DArray(S,0):Vt.setTexture2D(S,0),Mt.unbindTexture()},this.resetState=function(){Q=0,W=0,at=null,Mt.reset(),dt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return ii}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=he._getDrawingBufferColorSpace(t),e.unpackColorSpace=he._getUnpackColorSpace()}};var I_={type:"change"},Id={type:"start"},N_={type:"end"},_h=new $i,L_=new Cn,SA=Math.cos(70*md.DEG2RAD),nn=new k,zn=2*Math.PI,ye={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Pd=1e-6,yh=class extends uo{constructor(t,e=null){super(t,e),this.state=ye.NONE,this.target=new k,this.cursor=new k,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:ms.ROTATE,MIDDLE:ms.DOLLY,RIGHT:ms.PAN},this.touches={ONE:gs.ROTATE,TWO:gs.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new k,this._lastQuaternion=new Mn,this._lastTargetPosition=new k,this._quat=new Mn().setFromUnitVectors(t.up,new k(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new ps,this._sphericalDelta=new ps,this._scale=1,this._panOffset=new k,this._rotateStart=new zt,this._rotateEnd=new zt,this._rotateDelta=new zt,this._panStart=new zt,this._panEnd=new zt,this._panDelta=new zt,this._dollyStart=new zt,this._dollyEnd=new zt,this._dollyDelta=new zt,this._dollyDirection=new k,this._mouse=new zt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=AA.bind(this),this._onPointerDown=EA.bind(this),this._onPointerUp=TA.bind(this),this._onContextMenu=DA.bind(this),this._onMouseWheel=PA.bind(this),this._onKeyDown=IA.bind(this),this._onTouchStart=LA.bind(this),this._onTouchMove=NA.bind(this),this._onMouseDown=RA.bind(this),this._onMouseMove=CA.bind(this),this._interceptControlDown=OA.bind(this),this._interceptControlUp=UA.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=ye.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(I_),this.update(),this.state=ye.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;nn.copy(e).sub(this.target),nn.applyQuaternion(this._quat),this._spherical.setFromVector3(nn),this.autoRotate&&this.state===ye.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=zn:n>Math.PI&&(n-=zn),s<-Math.PI?s+=zn:s>Math.PI&&(s-=zn),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let a=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=a!=this._spherical.radius}if(nn.setFromSpherical(this._spherical),nn.applyQuaternion(this._quatInverse),e.copy(this.target).add(nn),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let a=null;if(this.object.isPerspectiveCamera){let o=nn.length();a=this._clampDistance(o*this._scale);let l=o-a;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let o=new k(this._mouse.x,this._mouse.y,0);o.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new k(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(o),this.object.updateMatrixWorld(),a=nn.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;a!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(a).add(this.object.position):(_h.origin.copy(this.object.position),_h.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(_h.direction))<SA?this.object.lookAt(this.target):(L_.setFromNormalAndCoplanarPoint(this.object.up,this.target),_h.intersectPlane(L_,this.target))))}else if(this.object.isOrthographicCamera){let a=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),a!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Pd||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Pd||this._lastTargetPosition.distanceToSquared(this.target)>Pd?(this.dispatchEvent(I_),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?zn/60*this.autoRotateSpeed*t:zn/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){nn.setFromMatrixColumn(e,0),nn.multiplyScalar(-t),this._panOffset.add(nn)}_panUp(t,e){this.screenSpacePanning===!0?nn.setFromMatrixColumn(e,1):(nn.setFromMatrixColumn(e,0),nn.crossVectors(this.object.up,nn)),nn.multiplyScalar(t),this._panOffset.add(nn)}_pan(t,e){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;nn.copy(s).sub(this.target);let r=nn.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,a=n.width,o=n.height;this._mouse.x=s/a*2-1,this._mouse.y=-(r/o)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(zn*this._rotateDelta.x/e.clientHeight),this._rotateUp(zn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(zn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-zn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(zn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-zn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(zn*this._rotateDelta.x/e.clientHeight),this._rotateUp(zn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let a=(t.pageX+e.x)*.5,o=(t.pageY+e.y)*.5;this._updateZoomParameters(a,o)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new zt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function EA(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function AA(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function TA(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(N_),this.state=ye.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function RA(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case ms.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=ye.DOLLY;break;case ms.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=ye.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=ye.ROTATE}break;case ms.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=ye.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=ye.PAN}break;default:this.state=ye.NONE}this.state!==ye.NONE&&this.dispatchEvent(Id)}function CA(i){switch(this.state){case ye.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case ye.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case ye.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function PA(i){this.enabled===!1||this.enableZoom===!1||this.state!==ye.NONE||(i.preventDefault(),this.dispatchEvent(Id),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(N_))}function IA(i){this.enabled!==!1&&this._handleKeyDown(i)}function LA(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case gs.ROTATE:if(this.enableRotate===!1){this.state=ye.NONE;break}this._handleTouchStartRotate(i),this.state=ye.TOUCH_ROTATE;break;case gs.PAN:if(this.enablePan===!1){this.state=ye.NONE;break}this._handleTouchStartPan(i),this.state=ye.TOUCH_PAN;break;default:this.state=ye.NONE}break;case 2:switch(this.touches.TWO){case gs.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=ye.TOUCH_DOLLY_PAN;break;case gs.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=ye.TOUCH_DOLLY_ROTATE;break;default:this.state=ye.NONE}break;default:this.state=ye.NONE}this.state!==ye.NONE&&this.dispatchEvent(Id)}function NA(i){switch(this._trackPointer(i),this.state){case ye.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case ye.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case ye.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case ye.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=ye.NONE}}function DA(i){this.enabled!==!1&&i.preventDefault()}function OA(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function UA(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var D_=1.7,Ld=22,xh=class{constructor(t,e){this.canvas=t,this.body=e;let n=t.getContext("webgl2",{antialias:!0,alpha:!1});if(!n)throw new Error("no WebGL");this.renderer=new ph({canvas:t,context:n}),this.renderer.shadowMap.enabled=!0,this.renderer.shadowMap.type=Hs,this.renderer.outputColorSpace=vn,this.scene=new Xa,this.scene.background=new Jt,this.scene.fog=new Wa(0,9,34),this.camera=new Pn(38,1,.05,200),this.controls=new yh(this.camera,t),Object.assign(this.controls,{enableDamping:!0,dampingFactor:.12,maxPolarAngle:1.53,minDistance:1,maxDistance:30}),this.controls.addEventListener("change",()=>{this.stale=!0}),this.bodies=[],this.shared=BA(e),this.addRoom(),this.paint(),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>this.paint()),t.addEventListener("webglcontextrestored",()=>{this.stale=!0}),this.resetView(),this.time=0}addRoom(){this.scene.add(new ro(16777215,12897238,1.9),new co(16777215,.35)),this.sun=new lo(16777215,1.7),this.sun.castShadow=!0,this.sun.shadow.mapSize.set(1024,1024),Object.assign(this.sun.shadow.camera,{left:-6,right:6,top:6,bottom:-6,near:.5,far:20}),this.sun.shadow.radius=4,this.scene.add(this.sun,this.sun.target);let t=new Bn(new Vs(200,200),new no({color:1844272,opacity:.22}));t.rotation.x=-Math.PI/2,t.receiveShadow=!0,this.grid=FA(30),this.scene.add(t,this.grid),this.line=new Gr(new Ln,new Gs({color:13649212})),this.line.frustumCulled=!1,this.scene.add(this.line),this.ring=new Bn(new eo(.34,.4,48),new kr({color:3108816,transparent:!0,opacity:.8})),this.ring.rotation.x=-Math.PI/2,this.ring.position.y=.006,this.ring.visible=!1,this.scene.add(this.ring)}paint(){let t=getComputedStyle(this.canvas),e=n=>t.getPropertyValue(n).trim();this.scene.fog.color.copy(this.scene.background.set(e("--room"))),this.grid.material.color.set(e("--grid")),this.stale=!0}show(t,e){for(;this.bodies.length>t.length;)this.scene.remove(this.bodies.pop().mesh);for(;this.bodies.length<t.length;)this.bodies.push(this.newBody());this.motions=t,this.chosen=e,this.offsets=t.map((n,s)=>(s-(t.length-1)/2)*D_),this.placeAt(this.time)}newBody(){let{geometry:t,parents:e,offsets:n,colours:s}=this.shared,r=e.map((l,c)=>{let h=new zr;return h.position.fromArray(n[c]),h});e.forEach((l,c)=>{l>=0&&r[l].add(r[c])});let a=new Ya(t,new io({vertexColors:!0}));a.castShadow=!0,a.frustumCulled=!1,a.add(r[0]);let o=this.body.skeleton.rest.map(([l,c,h])=>new re().makeTranslation(-l,-c,-h));return a.bind(new Ja(r,o),new re),this.scene.add(a),{mesh:a,bones:r,colours:s}}placeAt(t){this.time=t;let e=new Mn,n=new Mn;this.bodies.forEach(({mesh:s,bones:r},a)=>{let{frames:o,fps:l,quaternions:c,root:h}=this.motions[a],u=Math.min(Math.max(t*l,0),o-1),f=Math.floor(u),d=Math.min(f+1,o-1),p=u-f;for(let x=0;x<Ld;x++){let[w,M]=[(f*Ld+x)*4,(d*Ld+x)*4];e.set(c[w+1],c[w+2],c[w+3],c[w]),n.set(c[M+1],c[M+2],c[M+3],c[M]),r[x].quaternion.slerpQuaternions(e,n,p)}let[_,m,g]=[0,1,2].map(x=>h[f*3+x]+p*(h[d*3+x]-h[f*3+x]));r[0].position.set(_,m,g),s.position.x=this.offsets[a],a===this.chosen&&(this.ring.position.set(_+this.offsets[a],.006,g),this.focus=new k(_+this.offsets[a],0,g))}),this.ring.visible=this.bodies.length>1,this.stale=!0}showPath(t){let e=(t??[]).map(([n,s])=>new k(n+(this.offsets?.[this.chosen]??0),.01,s));this.line.geometry.dispose(),this.line.geometry=new Ln().setFromPoints(e),this.line.visible=e.length>1,this.stale=!0}floorAt(t){let e=this.canvas.getBoundingClientRect(),n=new zt((t.clientX-e.left)/e.width*2-1,1-(t.clientY-e.top)/e.height*2);this.camera.updateMatrixWorld();let s=new ho;s.setFromCamera(n,this.camera);let r=s.ray.intersectPlane(new Cn(new k(0,1,0)),new k);return r&&r.length()<60?[r.x-(this.offsets?.[this.chosen]??0),r.z]:null}takeAt(t){let e=this.canvas.getBoundingClientRect(),n=null,s=.07*e.width;return this.bodies.forEach(({bones:r},a)=>{let o=r[9].getWorldPosition(new k).project(this.camera),l=Math.hypot((o.x+1)/2*e.width+e.left-t.clientX,(1-o.y)/2*e.height+e.top-t.clientY);l<s&&(s=l,n=a)}),n}resetView(t=!1){let e=Math.max(0,(this.bodies?.length??1)-1),n=this.focus?this.focus.clone().setY(.85):new k(0,.85,0);if(this.bodies?.length>1&&(n.x=0),this.controls.target.copy(n),t)this.camera.position.set(n.x,11,n.z-3);else{let s=e*D_/2+.9,r=s/(Math.tan(this.camera.fov*Math.PI/360)*this.camera.aspect);this.camera.position.copy(n).add(new k(1.6/(1+e),.9,3.7).setLength(Math.max(4.1,r)))}this.controls.update(),this.stale=!0}turn(t,e,n=1){let{target:s}=this.controls,r=new ps().setFromVector3(this.camera.position.clone().sub(s));r.set(r.radius*n,r.phi-e,r.theta+t).makeSafe(),this.camera.position.setFromSpherical(r).add(s)}draw(t,e){if(t&&this.focus){let r=this.focus.clone();this.bodies.length>1&&(r.x=this.controls.target.x);let a=r.setY(this.controls.target.y).sub(this.controls.target).multiplyScalar(1-Math.exp(-4*e));this.controls.target.add(a),this.camera.position.add(a)}if(this.controls.update(),!this.stale)return;this.stale=!1;let{x:n,z:s}=this.controls.target;this.sun.target.position.set(n,0,s),this.sun.position.set(n+2.5,6,s+3),this.renderer.render(this.scene,this.camera),this.keepPace(e)}keepPace(t){this.late=t>.045?(this.late??0)+1:0,!(this.late<12||this.lean===2)&&(this.late=0,this.lean=(this.lean??0)+1,this.sun.castShadow=!1,this.resize())}resize(){let{clientWidth:t,clientHeight:e}=this.canvas.parentElement;!t||!e||(this.renderer.setPixelRatio(Math.min(window.devicePixelRatio,this.lean===2?.6:this.lean?1:2)),this.renderer.setSize(t,e,!1),this.camera.aspect=t/e,this.camera.updateProjectionMatrix(),this.stale=!0)}};function FA(i){let t=[];for(let s=-i;s<=i;s++)for(let r=-i;r<i;r++)t.push(s,0,r,s,0,r+1,r,0,s,r+1,0,s);let e=new Ln().setAttribute("position",new cn(new Float32Array(t),3)),n=new Ka(e,new Gs);return n.position.y=.002,n}function BA({skeleton:i,mesh:t,colours:e}){let n=(p,_)=>{let m=atob(p);return new _(Uint8Array.from(m,g=>g.charCodeAt(0)).buffer)},s=Float32Array.from(n(t.positions,Int16Array),p=>p*1e-4),r=Float32Array.from(n(t.normals,Int8Array),p=>p/127),a=n(t.joints,Uint8Array),o=n(t.weights,Uint8Array),l=new Float32Array(s.length),c=new Jt,[h,u,f]=["left","right","centre"].map(p=>new Jt().setRGB(...e[p],vn));for(let p=0;p<s.length/3;p++){let _=0;for(let m=0;m<4;m++)_+=o[p*4+m]/255*i.sides[a[p*4+m]];c.copy(f).lerp(_>0?h:u,Math.abs(_)).toArray(l,p*3)}let d=new Ln;return d.setAttribute("position",new cn(s,3)),d.setAttribute("normal",new cn(r,3)),d.setAttribute("color",new cn(l,3)),d.setAttribute("skinIndex",new cn(Uint16Array.from(a),4)),d.setAttribute("skinWeight",new cn(Float32Array.from(o,p=>p/255),4)),d.setIndex(new cn(n(t.triangles,Uint16Array),1)),{geometry:d,parents:i.parents,offsets:i.offsets,colours:e}}var kA=.5,vh=class{constructor(t,e){this.root=t,this.page=e,this.list=document.createElement("ol"),this.head=document.createElement("div"),this.head.className="playhead",t.append(this.list,this.head),new ResizeObserver(()=>this.fit()).observe(t)}show(){let{blocks:t}=this.page.scene,{selected:e}=this.page,n=[...this.list.children].findIndex(s=>s.contains(document.activeElement));this.list.replaceChildren(...t.map((s,r)=>this.item(s,r,e))),n>=0&&this.focus(Math.min(n,t.length-1)),this.fit(),e!==this.selected&&this.reveal(this.list.children[e]),this.selected=e}fit(){this.root.classList.toggle("long",this.list.scrollWidth>this.root.clientWidth)}reveal({offsetLeft:t,offsetWidth:e}){this.root.scrollLeft=Math.min(Math.max(this.root.scrollLeft,t+e-this.root.clientWidth),t)}focus(t){this.list.children[t].querySelector("button").focus()}move(t,e){this.page.moveBlock(t,e),this.focus(e)}item({text:t,seconds:e},n,s){let r=document.createElement("li"),a=document.createElement("button"),o=document.createElement("span");r.style.flexGrow=e,r.classList.toggle("selected",n===s),a.type="button",a.textContent=t||"…",a.title="Drag to move; arrow keys select, Alt moves, Shift stretches, Delete removes",a.setAttribute("aria-label",`Sentence ${n+1}: ${t||"empty"}, ${e} seconds`),a.setAttribute("aria-current",String(n===s));let l=document.createElement("small");return l.textContent=`${e} s`,o.className="handle",r.append(a,l,o),a.addEventListener("click",()=>this.page.select(n)),a.addEventListener("keydown",c=>this.key(c,n)),a.addEventListener("pointerdown",c=>this.drag(c,n,a)),o.addEventListener("pointerdown",c=>this.stretch(c,n)),r}key(t,e){let n={ArrowLeft:-1,ArrowRight:1}[t.key],{blocks:s}=this.page.scene,r=e+n;if(n&&t.shiftKey)this.page.stretchBlock(e,s[e].seconds+n*kA,`stretch${e}`);else if(n&&s[r]&&t.altKey)this.move(e,r);else if(n&&s[r])this.page.select(r),this.focus(r);else if(t.key==="Delete")this.page.removeBlock(e);else if(!n)return;t.preventDefault()}drag(t,e,n){if(t.button||!t.isPrimary)return;let s=t.clientX,r=!1,l=O_(t,({clientX:c})=>{r||=Math.abs(c-s)>6,r&&(n.parentElement.classList.add("dragged"),n.parentElement.style.transform=`translateX(${c-s}px)`)},({clientX:c})=>{if(l(),!r)return;let u=[...this.list.children].map((f,d)=>{let p=f.getBoundingClientRect();return d===e?null:(p.left+p.right)/2}).filter(f=>f!==null&&f<c).length;u===e?this.show():this.move(e,u)},()=>this.show())}stretch(t,e){if(t.button||!t.isPrimary)return;t.preventDefault();let n=t.clientX,{seconds:s}=this.page.scene.blocks[e],r=Ca(this.page.scene.blocks)/this.list.scrollWidth,a=()=>{o(),this.page.history.rest()},o=O_(t,({clientX:l})=>{let c=Math.min(Math.max(s+(l-n)*r,Qe.seconds[0]),Qe.seconds[1]);this.page.stretchBlock(e,c,`stretch${e}`)},a,a)}at(t){let{blocks:e}=this.page.scene,n=0;for(;n<e.length-1&&t>=e[n].seconds;n++)t-=e[n].seconds;return[n,t]}showPlayhead(t){let[e,n]=this.at(t),{offsetLeft:s,offsetWidth:r}=this.list.children[e],a=s+n/this.page.scene.blocks[e].seconds*r;this.head.style.left=`${100*a/this.list.clientWidth}%`}};function O_({pointerId:i},t,e,n){let s=new AbortController,r=()=>s.abort(),a=(o,l)=>addEventListener(o,c=>{c.pointerId===i&&l(c)},{signal:s.signal});return a("pointermove",t),a("pointerup",e),a("pointercancel",()=>{r(),n()}),r}var rt=i=>document.getElementById(i),zA=24,GA=1.1,Mh=.1,U_="Changed: Enter or Make makes it.";function k_(){globalThis.studio=new Nd,globalThis.studio.open().catch(i=>{rt("status").textContent=`The studio could not start: ${i.message}`,document.body.classList.add("failed")})}var Nd=class{async open(){this.settings=JSON.parse(rt("settings").textContent),$o(this.settings.skeleton),this.motions=new Map,this.clips=new Map,this.clipBefore=null,this.selected=0,this.time=0,this.history=new Ml(of(location.hash)??Eg,()=>this.changed());let t=rt("script").textContent,e=wg(document),n=this.scene.blocks.map(({text:l})=>l),s=vl.open(t,this.settings,e,n);this.openStage(),this.timeline=new vh(rt("timeline"),this),this.bind(),this.changed(),this.tell("Loading the model …"),this.timings={page:performance.now()},this.client=await s;let{glb:r,vrma:a,licences:o}=await e;Object.assign(this,{rest:{glb:r,vrma:a},licences:o}),this.timings.loaded=performance.now(),document.body.classList.add("ready"),rt("make").disabled=!1,await this.warn(),await this.make()}get scene(){return this.history.now}get clip(){return this.clips.get(this.scene.clip)??null}openStage(){try{this.stage=new xh(rt("stage"),this.settings.body)}catch{rt("no-stage").hidden=!1;return}rt("stage").tabIndex=0,new ResizeObserver(()=>this.stage.resize()).observe(rt("stage").parentElement),this.stage.resize();let t=performance.now(),e=n=>{let s=(n-t)/1e3;t=n,this.shown&&this.playing&&this.seek((this.time+Math.min(s,.25))%(this.seconds+.5)),this.stage.draw(rt("follow").checked&&!this.drawing,s),requestAnimationFrame(e)};requestAnimationFrame(e)}bind(){let t=rt("text");t.addEventListener("input",()=>{let e=t.value.length>Qe.text;this.editBlock({text:t.value},"text"),e&&this.tell(`A sentence has ${Qe.text} letters at most; what is beyond is cut off.`,"warning")}),t.addEventListener("blur",()=>this.history.rest()),t.addEventListener("keydown",e=>{e.key==="Enter"&&!e.shiftKey&&!e.isComposing&&(e.preventDefault(),this.make())}),rt("seconds").addEventListener("change",()=>this.editBlock({seconds:Os(rt("seconds").valueAsNumber,Qe.seconds,this.scene.blocks[this.selected].seconds)})),rt("seed").addEventListener("change",()=>this.history.change({seed:Os(rt("seed").valueAsNumber,[0,Qe.seed],this.scene.seed)})),rt("takes").addEventListener("change",()=>this.history.change({takes:rt("takes").value,chosen:0})),rt("dice").addEventListener("click",()=>{this.history.change({seed:Math.floor(Math.random()*1e5)}),this.make()}),rt("make").addEventListener("click",()=>this.make()),rt("stop").addEventListener("click",()=>this.stop()),rt("add").addEventListener("click",()=>this.addBlock()),rt("cut").addEventListener("click",()=>this.cutBlock()),rt("earlier").addEventListener("click",()=>this.moveBlock(this.selected,this.selected-1)),rt("later").addEventListener("click",()=>this.moveBlock(this.selected,this.selected+1)),rt("remove").addEventListener("click",()=>this.removeBlock()),rt("undo").addEventListener("click",()=>this.history.undo()),rt("redo").addEventListener("click",()=>this.history.redo()),rt("play").addEventListener("click",()=>this.setPlaying(!this.playing)),rt("scrub").addEventListener("input",()=>{this.setPlaying(!1),this.seek(rt("scrub").valueAsNumber)}),rt("view").addEventListener("click",()=>this.stage?.resetView()),rt("link").addEventListener("click",()=>this.copyLink());for(let e of["bvh","glb","vrma"])rt(`save-${e}`).addEventListener("click",()=>this.save(e));rt("save-film").addEventListener("click",()=>this.film());for(let[e,n]of Object.entries(Ra))rt("path").add(new Option(n.label,e));rt("path").querySelector("[value=draw]").disabled=!this.stage,rt("path").querySelector("[value=clip]").hidden=!0,rt("path").addEventListener("change",()=>this.choosePath(rt("path").value));for(let{language:e,prompt:n}of Sg(this.settings.languages))rt("examples").add(new Option(`${e}: ${n}`,n));rt("examples").addEventListener("change",()=>{rt("examples").value&&(this.editBlock({text:rt("examples").value}),this.make()),rt("examples").value=""}),addEventListener("keydown",e=>this.key(e)),addEventListener("hashchange",()=>{let e=of(location.hash);e?(this.history.change(e),this.make()):this.changed()}),this.bindStage(),this.bindClips(),rt("licences").addEventListener("click",()=>{rt("notices").querySelector("pre").textContent=this.licences?new TextDecoder().decode(this.licences):"",rt("notices").showModal()}),rt("about").textContent=`Model ${this.settings.name}: ${this.settings.licence}.`}key(t){let e=s=>t.target.closest?.(s),n=(t.ctrlKey||t.metaKey)&&!e("textarea, input[type=number]")&&t.key.toLowerCase();n==="y"||n==="z"&&t.shiftKey?(t.preventDefault(),this.history.redo()):n==="z"?(t.preventDefault(),this.history.undo()):t.key===" "&&!e("input, textarea, select, button, summary, dialog")?(t.preventDefault(),this.setPlaying(!this.playing)):t.key==="Escape"&&!t.isComposing&&!e("dialog")&&this.stop()}editBlock(t,e=null){let n=this.scene.blocks.map((s,r)=>r===this.selected?{...s,...t}:s);this.history.change({blocks:n},e&&`${e}${this.selected}`)}stretchBlock(t,e,n=null){this.history.change({blocks:this.scene.blocks.map((s,r)=>r===t?{...s,seconds:e}:s)},n)}addBlock(){if(this.scene.blocks.length>=Qe.blocks)return;let t=[...this.scene.blocks];t.splice(this.selected+1,0,{text:"",seconds:3}),this.selected++,this.history.change({blocks:t}),rt("text").focus()}cutBlock(){let t=[...this.scene.blocks],[e,n]=this.timeline.at(this.place),{text:s,seconds:r}=t[e],a=Math.round(n*10)/10,o=Math.round((r-a)*10)/10;if(Math.min(a,o)<Qe.seconds[0]){this.tell(`Move the playhead to where a sentence is to be cut; each part takes ${Qe.seconds[0]} seconds or more.`,"warning");return}t.splice(e,1,{text:s,seconds:a},{text:s,seconds:o}),this.selected=e+1,this.history.change({blocks:t})}moveBlock(t,e){if(e<0||e>=this.scene.blocks.length||t===e)return;let n=[...this.scene.blocks],[s]=n.splice(t,1);n.splice(e,0,s),this.selected=e,this.history.change({blocks:n})}removeBlock(t=this.selected){this.scene.blocks.length<2||(t<this.selected&&this.selected--,this.history.change({blocks:this.scene.blocks.filter((e,n)=>n!==t)}))}select(t){this.selected=t,this.history.rest(),this.changed()}changed(){let{blocks:t,seed:e,takes:n,chosen:s,path:r}=this.scene;this.selected=Math.min(this.selected,t.length-1);let a=t[this.selected];rt("text").value!==a.text&&(rt("text").value=a.text),rt("which").textContent=t.length>1?`Sentence ${this.selected+1} of ${t.length}`:"Sentence",rt("seconds").value=a.seconds,rt("seed").value=e,rt("takes").value=n,rt("remove").disabled=t.length<2,rt("earlier").disabled=this.selected===0,rt("later").disabled=this.selected===t.length-1,rt("undo").disabled=!this.history.past.length,rt("redo").disabled=!this.history.future.length;let o=r?Object.keys(Ra).find(l=>JSON.stringify(Ra[l].points)===JSON.stringify(r))??"drawn":"none";rt("path").querySelector("[value=drawn]").disabled=o!=="drawn",rt("path").disabled=!!this.clip,this.drawing||(rt("path").value=this.clip?"clip":o),this.timeline?.show(),clearTimeout(this.linkTimer),this.linkTimer=setTimeout(()=>history.replaceState(null,"",this.link()),300),this.clip!==this.clipBefore&&(this.clip&&this.putOnStage([this.clip.motion],0),this.tell(this.clip?`${this.clip.name}: ${(this.clip.motion.frames/St).toFixed(2)} seconds. Choose what is to be done with it, then make.`:"The clip is closed."),this.clipBefore=this.clip,this.showClip()),this.showMotions(s),this.stage?.showPath(this.clip?null:r),this.warnSoon()}get asked(){let{blocks:t,path:e,seed:n,takes:s}=this.scene;return{blocks:t,path:e,seed:n,takes:s,clip:this.clip?this.clipChoice():null}}keyOf(t,{blocks:e,path:n,clip:s,seed:r}=this.asked){return JSON.stringify([e,n,s&&{...s,motion:null},r+t])}async make(){if(!this.client)return;if(this.making){this.again=!0;return}let{asked:t}=this,{takes:e,seed:n,...s}=t,r=s.blocks.findIndex(({text:c})=>!/[\p{L}\p{N}]/u.test(c));if(r>=0&&!s.clip){this.select(r),this.tell("Say in a few words what the body does.","warning"),rt("text").focus();return}let{mode:a,keep:o}=s.clip??{},l={continue:[o,0],between:[o,o]}[a]??[0,0];await this.during(async()=>{let c=0;this.tell(e>1?`Making ${e} takes …`:"Making the motion …");for(let m=0;m<e;m++){let g=this.keyOf(m,t),x=e>1?`take ${m+1} …`:"",w=this.motions.get(g);if(this.motions.delete(g),w){this.motions.set(g,w);continue}rt("progress").textContent=x;let M=performance.now(),E=await this.client.call("make",{scene:s,seed:n+m},T=>{rt("progress").textContent=`${x} ${(T/St).toFixed(1)} s`});this.timings.motion=performance.now()-M,this.motions.set(g,{...E,kept:l,took:this.timings.motion}),this.motions.size>zA&&this.motions.delete(this.motions.keys().next().value),c++,this.showMotions(),this.timings.first??=performance.now()}let h=Array.from({length:e},(m,g)=>this.motions.get(this.keyOf(g,t))),u=F_(h),f=s.clip?"With the clip":"By its words",d=Math.abs(u-Ca(s.blocks))>.1?` ${f} it lasts ${u.toFixed(1)} s.`:"",p=(h.reduce((m,g)=>m+g.took,0)/1e3).toFixed(1),_=e>1?" Click a take to choose it.":"";this.tell(`${c?"Made":"Nothing has changed since it was made"} in ${p} s.${d}${_}`),await this.warn(),this.keyOf(0)!==this.keyOf(0,t)&&this.tell(U_)},()=>this.client.stop())}async during(t,e=()=>{}){this.halt=e,this.stopped=!1,this.setMaking(!0);try{await t()}catch(n){this.stopped?this.tell("Stopped; takes that are finished stay."):this.tell(n.message,"error")}await this.client?.opened,this.setMaking(!1),this.again&&(this.again=!1,this.make())}setMaking(t){this.making=t,document.body.classList.toggle("making",t),rt("make").setAttribute("aria-busy",String(t)),this.offerStop(),this.showButtons()}offerStop(){let t=this.drawing||this.making&&!this.stopped;!t&&document.activeElement===rt("stop")&&rt("make").focus({preventScroll:!0}),rt("stop").hidden=!t}stop(){if(this.drawing){this.stopDrawing(),this.tell("Nothing is drawn.");return}!this.making||this.stopped||(this.stopped=!0,this.again=!1,this.offerStop(),this.halt())}showMotions(){let{takes:t,chosen:e}=this.scene,n=Array.from({length:t},(a,o)=>this.motions.get(this.keyOf(o))),s=n.slice(0,n.includes(void 0)?n.indexOf(void 0):t),r=!!this.shown&&!s.length&&this.shown[0]!==this.clip?.motion;document.body.classList.toggle("stale",r),r&&!this.making&&!this.drawing&&this.tell(U_),s.length&&this.putOnStage(s,Math.min(e,s.length-1)),this.seek(this.time>this.seconds?0:this.time),this.showTakes(s.length),this.showButtons()}putOnStage(t,e){let n=this.shown;this.shown=t,this.choice=e,this.stage?.show(t,e),this.stage?.showPath(this.clip?null:this.scene.path),rt("stage").setAttribute("aria-label",`${t.length>1?`${t.length} bodies; take ${e+1} is chosen`:"A body"}: ${t[e].text||this.clip?.name}`),n||this.setPlaying(!matchMedia("(prefers-reduced-motion: reduce)").matches),n?.length!==t.length&&this.stage?.resetView(),rt("scrub").max=this.seconds}showButtons(){for(let t of["save-bvh","save-glb","save-vrma","use-motion"])rt(t).disabled=!this.shown;rt("play").disabled=!this.shown||!this.stage,rt("save-film").disabled=rt("play").disabled||this.making}showTakes(t){let{takes:e,chosen:n}=this.scene,s=rt("take-list"),r=e>1?e:0;for(;s.children.length>r;)s.lastElementChild.remove();for(let a=s.children.length;a<r;a++){let o=document.createElement("label"),l=document.createElement("input");Object.assign(l,{type:"radio",name:"take",value:a}),l.addEventListener("change",()=>this.choose(a)),o.append(l,`Take ${a+1}`),s.append(o)}for(let[a,o]of s.querySelectorAll("input").entries())Object.assign(o,{checked:a===n,disabled:a>=t})}choose(t){t<(this.shown?.length??0)&&this.history.change({chosen:t},"chosen")}setPlaying(t){this.playing=t&&!!(this.shown&&this.stage),rt("play").textContent=this.playing?"Pause":"Play"}seek(t){this.time=t,this.stage?.placeAt(t);let{seconds:e}=this,n=Math.min(t,e);rt("scrub").value=n,rt("scrub").setAttribute("aria-valuetext",`${n.toFixed(1)} seconds`),rt("clock").textContent=`${n.toFixed(2)} / ${e.toFixed(2)} s`,this.timeline?.showPlayhead(this.place)}get seconds(){return F_(this.shown??[])}get place(){let{kept:[t,e]=[0,0]}=this.shown?.[this.choice]??{},n=(this.time-t)/Math.max(this.seconds-t-e,.1);return Math.min(Math.max(n,0),1)*Ca(this.scene.blocks)}tell(t,e="note"){rt("status").textContent=t,rt("status").className=e,rt("progress").textContent=""}warnSoon(){clearTimeout(this.warnTimer),this.warnTimer=setTimeout(()=>this.warn().catch(()=>{}),400)}async warn(){if(!this.client)return;let t=[...new Set(this.scene.blocks.map(({text:a})=>a).filter(a=>a.trim()))],e=await Promise.all(t.map(a=>this.client.call("warning",{text:a}))),n=rt("warnings"),s=Array.from({length:this.scene.takes},(a,o)=>this.motions.get(this.keyOf(o))?.missed),r=[...new Set([...e,...s].filter(Boolean))];JSON.stringify(r)!==n.dataset.lines&&(n.dataset.lines=JSON.stringify(r),n.replaceChildren(...r.map(a=>{let o=document.createElement("li");return o.textContent=a,o})))}bindStage(){let t=rt("stage"),e=null;t.addEventListener("pointerdown",n=>{if(!n.isPrimary||(e=n,!this.drawing))return;t.setPointerCapture(n.pointerId);let s=this.stage.floorAt(n);this.line=s?[s]:[]}),t.addEventListener("pointermove",n=>{if(!this.drawing||!this.line?.length||n.pointerId!==e?.pointerId)return;let s=this.stage.floorAt(n),r=this.line[this.line.length-1];s&&Math.hypot(s[0]-r[0],s[1]-r[1])>.12&&(this.line.push(s),this.stage.showPath(this.line))}),t.addEventListener("pointercancel",n=>{n.pointerId===e?.pointerId&&(e=this.line=null,this.stage?.showPath(this.clip?null:this.scene.path))}),t.addEventListener("pointerup",n=>{if(n.pointerId===e?.pointerId){if(this.drawing&&this.line?.length){let s=this.line;this.stopDrawing(),s.length>2?this.takePath(s):this.tell("Draw a longer line on the floor.","warning")}else if(Math.hypot(n.clientX-e.clientX,n.clientY-e.clientY)<5){let s=this.stage?.takeAt(n);s!=null&&this.choose(s)}e=null}}),t.addEventListener("keydown",n=>{let s={ArrowLeft:[-Mh,0],ArrowRight:[Mh,0],ArrowUp:[0,Mh],ArrowDown:[0,-Mh],"+":[0,0,.9],"-":[0,0,1.1111111111111112]}[n.key];!s||this.drawing||n.ctrlKey||n.metaKey||n.altKey||(n.preventDefault(),this.stage?.turn(...s))})}choosePath(t){if(t==="draw"){this.playsAfter=this.playing,this.drawing=!0,this.setPlaying(!1),this.stage.controls.enabled=!1,this.stage.resetView(!0),document.body.classList.add("drawing"),this.tell("Draw the way on the floor with one stroke."),this.offerStop(),rt("stage").scrollIntoView({block:"nearest"});return}this.stopDrawing(),t!=="drawn"&&this.takePath(Ra[t].points)}takePath(t){let{blocks:e}=this.scene;if(t&&e.length===1){let n=Math.ceil(dr(t)/GA+1);this.history.change({path:t,blocks:[{...e[0],seconds:n}]})}else this.history.change({path:t});this.make()}stopDrawing(){this.drawing&&(this.drawing=!1,this.line=null,this.stage.controls.enabled=!0,this.stage.resetView(),this.stage.showPath(this.scene.path),document.body.classList.remove("drawing"),this.offerStop(),this.setPlaying(this.playsAfter),this.changed())}bindClips(){rt("open").addEventListener("click",()=>rt("file").click()),rt("file").addEventListener("change",()=>{rt("file").files[0]&&this.openClip(rt("file").files[0]),rt("file").value=""}),addEventListener("dragover",t=>{t.preventDefault(),document.body.classList.add("dropping")}),addEventListener("dragleave",t=>{t.relatedTarget||document.body.classList.remove("dropping")}),addEventListener("drop",t=>{t.preventDefault(),document.body.classList.remove("dropping"),t.dataTransfer.files[0]&&this.openClip(t.dataTransfer.files[0])});for(let t of["mode","from","until","keep","joints"])rt(t).addEventListener("change",({target:e})=>{e.type==="number"&&(e.value=Os(e.valueAsNumber,[Number(e.min),Number(e.max||1/0)],e.defaultValue)),this.showClip(),this.showMotions()});rt("use-motion").addEventListener("click",()=>this.takeClip(this.shown[this.choice],"this motion")),rt("close-clip").addEventListener("click",()=>this.history.change({clip:null}));for(let t of Object.keys(this.settings.skeleton.groups))rt("joints").add(new Option(t.replace("-"," "),t));this.showClip()}async openClip(t){try{if(t.size>64<<20)throw new Error("The file is larger than 64 MB.");let e=await t.arrayBuffer().catch(()=>{throw new Error("It cannot be read; of a folder, drop one of its clips.")});this.takeClip(vg(t.name,new Uint8Array(e),this.settings.profiles),t.name),this.seek(0),this.stage?.resetView()}catch(e){this.tell(`${t.name}: ${e.message}`,"error")}}takeClip(t,e){this.stopDrawing();let n=this.clips.size+1;this.clips.set(n,{motion:t,name:e,number:n});let s=t.frames/St;rt("until").value=Math.min(s,2).toFixed(1),rt("from").value=Math.min(1,s/3).toFixed(1),this.history.change({clip:n})}clipChoice(){let{motion:t,number:e}=this.clip,n=rt("joints").value==="all"?[]:[rt("joints").value],[s,r,a]=["from","until","keep"].map(o=>rt(o).valueAsNumber);return{mode:rt("mode").value,from:s,until:r,keep:a,joints:n,motion:t,number:e}}showClip(){document.body.classList.toggle("with-clip",!!this.clip),rt("clip-name").textContent=this.clip?`${this.clip.name}, ${(this.clip.motion.frames/St).toFixed(1)} s`:"";let t=rt("mode").value==="redo";for(let e of["from","until","joints"])rt(e).closest("label").hidden=!t;rt("keep").closest("label").hidden=t}fileName(t){return`${this.shown[this.choice].text.normalize("NFKC").replace(/[^\p{L}\p{N}]+/gu,"-").replace(/^-+|-+$/g,"").slice(0,48)||"motion"}.${t}`}bytes(t){let e=this.shown[this.choice];return t==="bvh"?new TextEncoder().encode(ig(e)):ag(e,this.rest[t])}save(t){B_(new Blob([this.bytes(t)],{type:t==="bvh"?"text/plain":"model/gltf-binary"}),this.fileName(t)),this.tell(`Saved ${this.fileName(t)}.`)}async film(){let t=this.playing;this.setPlaying(!1),await this.during(async()=>{this.tell("Filming in real time …");let{blob:e,kind:n}=await Mg(rt("stage"),this.seconds,s=>(this.seek(s),!this.stopped));if(this.stopped){this.tell("Stopped; no film is saved.");return}B_(e,this.fileName(n)),this.tell(`Saved ${this.fileName(n)}.`)}),this.setPlaying(t)}link(){return`${location.href.split("#")[0]}#${Tg(this.scene)}`}async copyLink(){let t=this.clip?" The clip is not in it.":"";try{await navigator.clipboard.writeText(this.link()),this.tell(`The link that carries this scene is copied.${t}`)}catch{this.tell(`The link in the address bar carries this scene.${t}`)}}},F_=i=>Math.max(0,...i.map(({frames:t,fps:e})=>(t-1)/e));function B_(i,t){let e=document.createElement("a");e.href=URL.createObjectURL(i),e.download=t,e.click(),setTimeout(()=>URL.revokeObjectURL(e.href),6e4)}typeof document>"u"?ng(self):k_();})();
