var studioAddress="studio://page/studio.js",studioOrigin="null";
(()=>{var bs=(i=>typeof require<"u"?require:typeof Proxy<"u"?new Proxy(i,{get:(t,e)=>(typeof require<"u"?require:t)[e]}):i)(function(i){if(typeof require<"u")return require.apply(this,arguments);throw Error('Dynamic require of "'+i+'" is not supported')});var Yh=Object.defineProperty,N_=Object.getOwnPropertyDescriptor,D_=Object.getOwnPropertyNames,O_=Object.prototype.hasOwnProperty,U_=(i=>typeof bs<"u"?bs:typeof Proxy<"u"?new Proxy(i,{get:(t,e)=>(typeof bs<"u"?bs:t)[e]}):i)(function(i){if(typeof bs<"u")return bs.apply(this,arguments);throw Error('Dynamic require of "'+i+'" is not supported')}),de=(i,t)=>()=>(i&&(t=i(i=0)),t),Bo=(i,t)=>{for(var e in t)Yh(i,e,{get:t[e],enumerable:!0})},F_=(i,t,e,n)=>{if(t&&typeof t=="object"||typeof t=="function")for(let s of D_(t))!O_.call(i,s)&&s!==e&&Yh(i,s,{get:()=>t[s],enumerable:!(n=N_(t,s))||n.enumerable});return i},Hh=i=>F_(Yh({},"__esModule",{value:!0}),i),ra,Ki,Oo,Ld,Zd,Jd=de(()=>{"use strict";ra=new Map,Ki=[],Oo=(i,t,e)=>{if(t&&typeof t.init=="function"&&typeof t.createInferenceSessionHandler=="function"){let n=ra.get(i);if(n===void 0)ra.set(i,{backend:t,priority:e});else{if(n.priority>e)return;if(n.priority===e&&n.backend!==t)throw new Error(`cannot register backend "${i}" using priority ${e}`)}if(e>=0){let s=Ki.indexOf(i);s!==-1&&Ki.splice(s,1);for(let r=0;r<Ki.length;r++)if(ra.get(Ki[r]).priority<=e){Ki.splice(r,0,i);return}Ki.push(i)}return}throw new TypeError("not a valid backend")},Ld=async i=>{let t=ra.get(i);if(!t)return"backend not found.";if(t.initialized)return t.backend;if(t.aborted)return t.error;{let e=!!t.initPromise;try{return e||(t.initPromise=t.backend.init(i)),await t.initPromise,t.initialized=!0,t.backend}catch(n){return e||(t.error=`${n}`,t.aborted=!0),t.error}finally{delete t.initPromise}}},Zd=async i=>{let t=i.executionProviders||[],e=t.map(l=>typeof l=="string"?l:l.name),n=e.length===0?Ki:e,s,r=[],a=new Set;for(let l of n){let c=await Ld(l);typeof c=="string"?r.push({name:l,err:c}):(s||(s=c),s===c&&a.add(l))}if(!s)throw new Error(`no available backend found. ERR: ${r.map(l=>`[${l.name}] ${l.err}`).join(", ")}`);for(let{name:l,err:c}of r)e.includes(l)&&console.warn(`removing requested execution provider "${l}" from session options because it is not available: ${c}`);let o=t.filter(l=>a.has(typeof l=="string"?l:l.name));return[s,new Proxy(i,{get:(l,c)=>c==="executionProviders"?o:Reflect.get(l,c)})]}}),B_=de(()=>{"use strict";Jd()}),Kd,k_=de(()=>{"use strict";Kd="1.23.2"}),Th,an,jd=de(()=>{"use strict";k_(),Th="warning",an={wasm:{},webgl:{},webgpu:{},versions:{common:Kd},set logLevel(i){if(i!==void 0){if(typeof i!="string"||["verbose","info","warning","error","fatal"].indexOf(i)===-1)throw new Error(`Unsupported logging level: ${i}`);Th=i}},get logLevel(){return Th}},Object.defineProperty(an,"logLevel",{enumerable:!0})}),Re,z_=de(()=>{"use strict";jd(),Re=an}),Qd,tp,G_=de(()=>{"use strict";Qd=(i,t)=>{let e=typeof document<"u"?document.createElement("canvas"):new OffscreenCanvas(1,1);e.width=i.dims[3],e.height=i.dims[2];let n=e.getContext("2d");if(n!=null){let s,r;t?.tensorLayout!==void 0&&t.tensorLayout==="NHWC"?(s=i.dims[2],r=i.dims[3]):(s=i.dims[3],r=i.dims[2]);let a=t?.format!==void 0?t.format:"RGB",o=t?.norm,l,c;o===void 0||o.mean===void 0?l=[255,255,255,255]:typeof o.mean=="number"?l=[o.mean,o.mean,o.mean,o.mean]:(l=[o.mean[0],o.mean[1],o.mean[2],0],o.mean[3]!==void 0&&(l[3]=o.mean[3])),o===void 0||o.bias===void 0?c=[0,0,0,0]:typeof o.bias=="number"?c=[o.bias,o.bias,o.bias,o.bias]:(c=[o.bias[0],o.bias[1],o.bias[2],0],o.bias[3]!==void 0&&(c[3]=o.bias[3]));let h=r*s,u=0,f=h,d=h*2,m=-1;a==="RGBA"?(u=0,f=h,d=h*2,m=h*3):a==="RGB"?(u=0,f=h,d=h*2):a==="RBG"&&(u=0,d=h,f=h*2);for(let _=0;_<r;_++)for(let p=0;p<s;p++){let g=(i.data[u++]-c[0])*l[0],y=(i.data[f++]-c[1])*l[1],w=(i.data[d++]-c[2])*l[2],b=m===-1?255:(i.data[m++]-c[3])*l[3];n.fillStyle="rgba("+g+","+y+","+w+","+b+")",n.fillRect(p,_,1,1)}if("toDataURL"in e)return e.toDataURL();throw new Error("toDataURL is not supported")}else throw new Error("Can not access image data")},tp=(i,t)=>{let e=typeof document<"u"?document.createElement("canvas").getContext("2d"):new OffscreenCanvas(1,1).getContext("2d"),n;if(e!=null){let s,r,a;t?.tensorLayout!==void 0&&t.tensorLayout==="NHWC"?(s=i.dims[2],r=i.dims[1],a=i.dims[3]):(s=i.dims[3],r=i.dims[2],a=i.dims[1]);let o=t!==void 0&&t.format!==void 0?t.format:"RGB",l=t?.norm,c,h;l===void 0||l.mean===void 0?c=[255,255,255,255]:typeof l.mean=="number"?c=[l.mean,l.mean,l.mean,l.mean]:(c=[l.mean[0],l.mean[1],l.mean[2],255],l.mean[3]!==void 0&&(c[3]=l.mean[3])),l===void 0||l.bias===void 0?h=[0,0,0,0]:typeof l.bias=="number"?h=[l.bias,l.bias,l.bias,l.bias]:(h=[l.bias[0],l.bias[1],l.bias[2],0],l.bias[3]!==void 0&&(h[3]=l.bias[3]));let u=r*s;if(t!==void 0&&(t.format!==void 0&&a===4&&t.format!=="RGBA"||a===3&&t.format!=="RGB"&&t.format!=="BGR"))throw new Error("Tensor format doesn't match input tensor dims");let f=4,d=0,m=1,_=2,p=3,g=0,y=u,w=u*2,b=-1;o==="RGBA"?(g=0,y=u,w=u*2,b=u*3):o==="RGB"?(g=0,y=u,w=u*2):o==="RBG"&&(g=0,w=u,y=u*2),n=e.createImageData(s,r);for(let E=0;E<r*s;d+=f,m+=f,_+=f,p+=f,E++)n.data[d]=(i.data[g++]-h[0])*c[0],n.data[m]=(i.data[y++]-h[1])*c[1],n.data[_]=(i.data[w++]-h[2])*c[2],n.data[p]=b===-1?255:(i.data[b++]-h[3])*c[3]}else throw new Error("Can not access image data");return n}}),Co,ep,np,ip,sp,rp,V_=de(()=>{"use strict";Zh(),Co=(i,t)=>{if(i===void 0)throw new Error("Image buffer must be defined");if(t.height===void 0||t.width===void 0)throw new Error("Image height and width must be defined");if(t.tensorLayout==="NHWC")throw new Error("NHWC Tensor layout is not supported yet");let{height:e,width:n}=t,s=t.norm??{mean:255,bias:0},r,a;typeof s.mean=="number"?r=[s.mean,s.mean,s.mean,s.mean]:r=[s.mean[0],s.mean[1],s.mean[2],s.mean[3]??255],typeof s.bias=="number"?a=[s.bias,s.bias,s.bias,s.bias]:a=[s.bias[0],s.bias[1],s.bias[2],s.bias[3]??0];let o=t.format!==void 0?t.format:"RGBA",l=t.tensorFormat!==void 0&&t.tensorFormat!==void 0?t.tensorFormat:"RGB",c=e*n,h=l==="RGBA"?new Float32Array(c*4):new Float32Array(c*3),u=4,f=0,d=1,m=2,_=3,p=0,g=c,y=c*2,w=-1;o==="RGB"&&(u=3,f=0,d=1,m=2,_=-1),l==="RGBA"?w=c*3:l==="RBG"?(p=0,y=c,g=c*2):l==="BGR"&&(y=0,g=c,p=c*2);for(let b=0;b<c;b++,f+=u,m+=u,d+=u,_+=u)h[p++]=(i[f]+a[0])/r[0],h[g++]=(i[d]+a[1])/r[1],h[y++]=(i[m]+a[2])/r[2],w!==-1&&_!==-1&&(h[w++]=(i[_]+a[3])/r[3]);return l==="RGBA"?new zn("float32",h,[1,4,e,n]):new zn("float32",h,[1,3,e,n])},ep=async(i,t)=>{let e=typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement,n=typeof ImageData<"u"&&i instanceof ImageData,s=typeof ImageBitmap<"u"&&i instanceof ImageBitmap,r=typeof i=="string",a,o=t??{},l=()=>{if(typeof document<"u")return document.createElement("canvas");if(typeof OffscreenCanvas<"u")return new OffscreenCanvas(1,1);throw new Error("Canvas is not supported")},c=h=>typeof HTMLCanvasElement<"u"&&h instanceof HTMLCanvasElement||h instanceof OffscreenCanvas?h.getContext("2d"):null;if(e){let h=l();h.width=i.width,h.height=i.height;let u=c(h);if(u!=null){let f=i.height,d=i.width;if(t!==void 0&&t.resizedHeight!==void 0&&t.resizedWidth!==void 0&&(f=t.resizedHeight,d=t.resizedWidth),t!==void 0){if(o=t,t.tensorFormat!==void 0)throw new Error("Image input config format must be RGBA for HTMLImageElement");o.tensorFormat="RGBA",o.height=f,o.width=d}else o.tensorFormat="RGBA",o.height=f,o.width=d;u.drawImage(i,0,0),a=u.getImageData(0,0,d,f).data}else throw new Error("Can not access image data")}else if(n){let h,u;if(t!==void 0&&t.resizedWidth!==void 0&&t.resizedHeight!==void 0?(h=t.resizedHeight,u=t.resizedWidth):(h=i.height,u=i.width),t!==void 0&&(o=t),o.format="RGBA",o.height=h,o.width=u,t!==void 0){let f=l();f.width=u,f.height=h;let d=c(f);if(d!=null)d.putImageData(i,0,0),a=d.getImageData(0,0,u,h).data;else throw new Error("Can not access image data")}else a=i.data}else if(s){if(t===void 0)throw new Error("Please provide image config with format for Imagebitmap");let h=l();h.width=i.width,h.height=i.height;let u=c(h);if(u!=null){let f=i.height,d=i.width;return u.drawImage(i,0,0,d,f),a=u.getImageData(0,0,d,f).data,o.height=f,o.width=d,Co(a,o)}else throw new Error("Can not access image data")}else{if(r)return new Promise((h,u)=>{let f=l(),d=c(f);if(!i||!d)return u();let m=new Image;m.crossOrigin="Anonymous",m.src=i,m.onload=()=>{f.width=m.width,f.height=m.height,d.drawImage(m,0,0,f.width,f.height);let _=d.getImageData(0,0,f.width,f.height);o.height=f.height,o.width=f.width,h(Co(_.data,o))}});throw new Error("Input data provided is not supported - aborted tensor creation")}if(a!==void 0)return Co(a,o);throw new Error("Input data provided is not supported - aborted tensor creation")},np=(i,t)=>{let{width:e,height:n,download:s,dispose:r}=t,a=[1,n,e,4];return new zn({location:"texture",type:"float32",texture:i,dims:a,download:s,dispose:r})},ip=(i,t)=>{let{dataType:e,dims:n,download:s,dispose:r}=t;return new zn({location:"gpu-buffer",type:e??"float32",gpuBuffer:i,dims:n,download:s,dispose:r})},sp=(i,t)=>{let{dataType:e,dims:n,download:s,dispose:r}=t;return new zn({location:"ml-tensor",type:e??"float32",mlTensor:i,dims:n,download:s,dispose:r})},rp=(i,t,e)=>new zn({location:"cpu-pinned",type:i,data:t,dims:e??[t.length]})}),As,ha,Rh,ap,H_=de(()=>{"use strict";As=new Map([["float32",Float32Array],["uint8",Uint8Array],["int8",Int8Array],["uint16",Uint16Array],["int16",Int16Array],["int32",Int32Array],["bool",Uint8Array],["float64",Float64Array],["uint32",Uint32Array],["int4",Uint8Array],["uint4",Uint8Array]]),ha=new Map([[Float32Array,"float32"],[Uint8Array,"uint8"],[Int8Array,"int8"],[Uint16Array,"uint16"],[Int16Array,"int16"],[Int32Array,"int32"],[Float64Array,"float64"],[Uint32Array,"uint32"]]),Rh=!1,ap=()=>{if(!Rh){Rh=!0;let i=typeof BigInt64Array<"u"&&BigInt64Array.from,t=typeof BigUint64Array<"u"&&BigUint64Array.from,e=globalThis.Float16Array,n=typeof e<"u"&&e.from;i&&(As.set("int64",BigInt64Array),ha.set(BigInt64Array,"int64")),t&&(As.set("uint64",BigUint64Array),ha.set(BigUint64Array,"uint64")),n?(As.set("float16",e),ha.set(e,"float16")):As.set("float16",Uint16Array)}}}),op,lp,W_=de(()=>{"use strict";Zh(),op=i=>{let t=1;for(let e=0;e<i.length;e++){let n=i[e];if(typeof n!="number"||!Number.isSafeInteger(n))throw new TypeError(`dims[${e}] must be an integer, got: ${n}`);if(n<0)throw new RangeError(`dims[${e}] must be a non-negative integer, got: ${n}`);t*=n}return t},lp=(i,t)=>{switch(i.location){case"cpu":return new zn(i.type,i.data,t);case"cpu-pinned":return new zn({location:"cpu-pinned",data:i.data,type:i.type,dims:t});case"texture":return new zn({location:"texture",texture:i.texture,type:i.type,dims:t});case"gpu-buffer":return new zn({location:"gpu-buffer",gpuBuffer:i.gpuBuffer,type:i.type,dims:t});case"ml-tensor":return new zn({location:"ml-tensor",mlTensor:i.mlTensor,type:i.type,dims:t});default:throw new Error(`tensorReshape: tensor location ${i.location} is not supported`)}}}),zn,Zh=de(()=>{"use strict";G_(),V_(),H_(),W_(),zn=class{constructor(i,t,e){ap();let n,s;if(typeof i=="object"&&"location"in i)switch(this.dataLocation=i.location,n=i.type,s=i.dims,i.location){case"cpu-pinned":{let a=As.get(n);if(!a)throw new TypeError(`unsupported type "${n}" to create tensor from pinned buffer`);if(!(i.data instanceof a))throw new TypeError(`buffer should be of type ${a.name}`);this.cpuData=i.data;break}case"texture":{if(n!=="float32")throw new TypeError(`unsupported type "${n}" to create tensor from texture`);this.gpuTextureData=i.texture,this.downloader=i.download,this.disposer=i.dispose;break}case"gpu-buffer":{if(n!=="float32"&&n!=="float16"&&n!=="int32"&&n!=="int64"&&n!=="uint32"&&n!=="uint8"&&n!=="bool"&&n!=="uint4"&&n!=="int4")throw new TypeError(`unsupported type "${n}" to create tensor from gpu buffer`);this.gpuBufferData=i.gpuBuffer,this.downloader=i.download,this.disposer=i.dispose;break}case"ml-tensor":{if(n!=="float32"&&n!=="float16"&&n!=="int32"&&n!=="int64"&&n!=="uint32"&&n!=="uint64"&&n!=="int8"&&n!=="uint8"&&n!=="bool"&&n!=="uint4"&&n!=="int4")throw new TypeError(`unsupported type "${n}" to create tensor from MLTensor`);this.mlTensorData=i.mlTensor,this.downloader=i.download,this.disposer=i.dispose;break}default:throw new Error(`Tensor constructor: unsupported location '${this.dataLocation}'`)}else{let a,o;if(typeof i=="string")if(n=i,o=e,i==="string"){if(!Array.isArray(t))throw new TypeError("A string tensor's data must be a string array.");a=t}else{let l=As.get(i);if(l===void 0)throw new TypeError(`Unsupported tensor type: ${i}.`);if(Array.isArray(t)){if(i==="float16"&&l===Uint16Array||i==="uint4"||i==="int4")throw new TypeError(`Creating a ${i} tensor from number array is not supported. Please use ${l.name} as data.`);i==="uint64"||i==="int64"?a=l.from(t,BigInt):a=l.from(t)}else if(t instanceof l)a=t;else if(t instanceof Uint8ClampedArray)if(i==="uint8")a=Uint8Array.from(t);else throw new TypeError("A Uint8ClampedArray tensor's data must be type of uint8");else if(i==="float16"&&t instanceof Uint16Array&&l!==Uint16Array)a=new globalThis.Float16Array(t.buffer,t.byteOffset,t.length);else throw new TypeError(`A ${n} tensor's data must be type of ${l}`)}else if(o=t,Array.isArray(i)){if(i.length===0)throw new TypeError("Tensor type cannot be inferred from an empty array.");let l=typeof i[0];if(l==="string")n="string",a=i;else if(l==="boolean")n="bool",a=Uint8Array.from(i);else throw new TypeError(`Invalid element type of data array: ${l}.`)}else if(i instanceof Uint8ClampedArray)n="uint8",a=Uint8Array.from(i);else{let l=ha.get(i.constructor);if(l===void 0)throw new TypeError(`Unsupported type for tensor data: ${i.constructor}.`);n=l,a=i}if(o===void 0)o=[a.length];else if(!Array.isArray(o))throw new TypeError("A tensor's dims must be a number array");s=o,this.cpuData=a,this.dataLocation="cpu"}let r=op(s);if(this.cpuData&&r!==this.cpuData.length&&!((n==="uint4"||n==="int4")&&Math.ceil(r/2)===this.cpuData.length))throw new Error(`Tensor's size(${r}) does not match data length(${this.cpuData.length}).`);this.type=n,this.dims=s,this.size=r}static async fromImage(i,t){return ep(i,t)}static fromTexture(i,t){return np(i,t)}static fromGpuBuffer(i,t){return ip(i,t)}static fromMLTensor(i,t){return sp(i,t)}static fromPinnedBuffer(i,t,e){return rp(i,t,e)}toDataURL(i){return Qd(this,i)}toImageData(i){return tp(this,i)}get data(){if(this.ensureValid(),!this.cpuData)throw new Error("The data is not on CPU. Use `getData()` to download GPU data to CPU, or use `texture` or `gpuBuffer` property to access the GPU data directly.");return this.cpuData}get location(){return this.dataLocation}get texture(){if(this.ensureValid(),!this.gpuTextureData)throw new Error("The data is not stored as a WebGL texture.");return this.gpuTextureData}get gpuBuffer(){if(this.ensureValid(),!this.gpuBufferData)throw new Error("The data is not stored as a WebGPU buffer.");return this.gpuBufferData}get mlTensor(){if(this.ensureValid(),!this.mlTensorData)throw new Error("The data is not stored as a WebNN MLTensor.");return this.mlTensorData}async getData(i){switch(this.ensureValid(),this.dataLocation){case"cpu":case"cpu-pinned":return this.data;case"texture":case"gpu-buffer":case"ml-tensor":{if(!this.downloader)throw new Error("The current tensor is not created with a specified data downloader.");if(this.isDownloading)throw new Error("The current tensor is being downloaded.");try{this.isDownloading=!0;let t=await this.downloader();return this.downloader=void 0,this.dataLocation="cpu",this.cpuData=t,i&&this.disposer&&(this.disposer(),this.disposer=void 0),t}finally{this.isDownloading=!1}}default:throw new Error(`cannot get data from location: ${this.dataLocation}`)}}dispose(){if(this.isDownloading)throw new Error("The current tensor is being downloaded.");this.disposer&&(this.disposer(),this.disposer=void 0),this.cpuData=void 0,this.gpuTextureData=void 0,this.gpuBufferData=void 0,this.mlTensorData=void 0,this.downloader=void 0,this.isDownloading=void 0,this.dataLocation="none"}ensureValid(){if(this.dataLocation==="none")throw new Error("The tensor is disposed.")}reshape(i){if(this.ensureValid(),this.downloader||this.disposer)throw new Error("Cannot reshape a tensor that owns GPU resource.");return lp(this,i)}}}),on,cp=de(()=>{"use strict";Zh(),on=zn}),Wh,Ch,er,nr,ir,sr,hp=de(()=>{"use strict";jd(),Wh=(i,t)=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||console.timeStamp(`${i}::ORT::${t}`)},Ch=(i,t)=>{let e=new Error().stack?.split(/\r\n|\r|\n/g)||[],n=!1;for(let s=0;s<e.length;s++){if(n&&!e[s].includes("TRACE_FUNC")){let r=`FUNC_${i}::${e[s].trim().split(" ")[1]}`;t&&(r+=`::${t}`),Wh("CPU",r);return}e[s].includes("TRACE_FUNC")&&(n=!0)}},er=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||Ch("BEGIN",i)},nr=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||Ch("END",i)},ir=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||console.time(`ORT::${i}`)},sr=i=>{(typeof an.trace>"u"?!an.wasm.trace:!an.trace)||console.timeEnd(`ORT::${i}`)}}),up,X_=de(()=>{"use strict";Jd(),cp(),hp(),up=class fp{constructor(t){this.handler=t}async run(t,e,n){er(),ir("InferenceSession.run");let s={},r={};if(typeof t!="object"||t===null||t instanceof on||Array.isArray(t))throw new TypeError("'feeds' must be an object that use input names as keys and OnnxValue as corresponding values.");let a=!0;if(typeof e=="object"){if(e===null)throw new TypeError("Unexpected argument[1]: cannot be null.");if(e instanceof on)throw new TypeError("'fetches' cannot be a Tensor");if(Array.isArray(e)){if(e.length===0)throw new TypeError("'fetches' cannot be an empty array.");a=!1;for(let c of e){if(typeof c!="string")throw new TypeError("'fetches' must be a string array or an object.");if(this.outputNames.indexOf(c)===-1)throw new RangeError(`'fetches' contains invalid output name: ${c}.`);s[c]=null}if(typeof n=="object"&&n!==null)r=n;else if(typeof n<"u")throw new TypeError("'options' must be an object.")}else{let c=!1,h=Object.getOwnPropertyNames(e);for(let u of this.outputNames)if(h.indexOf(u)!==-1){let f=e[u];(f===null||f instanceof on)&&(c=!0,a=!1,s[u]=f)}if(c){if(typeof n=="object"&&n!==null)r=n;else if(typeof n<"u")throw new TypeError("'options' must be an object.")}else r=e}}else if(typeof e<"u")throw new TypeError("Unexpected argument[1]: must be 'fetches' or 'options'.");for(let c of this.inputNames)if(typeof t[c]>"u")throw new Error(`input '${c}' is missing in 'feeds'.`);if(a)for(let c of this.outputNames)s[c]=null;let o=await this.handler.run(t,s,r),l={};for(let c in o)if(Object.hasOwnProperty.call(o,c)){let h=o[c];h instanceof on?l[c]=h:l[c]=new on(h.type,h.data,h.dims)}return sr("InferenceSession.run"),nr(),l}async release(){return this.handler.dispose()}static async create(t,e,n,s){er(),ir("InferenceSession.create");let r,a={};if(typeof t=="string"){if(r=t,typeof e=="object"&&e!==null)a=e;else if(typeof e<"u")throw new TypeError("'options' must be an object.")}else if(t instanceof Uint8Array){if(r=t,typeof e=="object"&&e!==null)a=e;else if(typeof e<"u")throw new TypeError("'options' must be an object.")}else if(t instanceof ArrayBuffer||typeof SharedArrayBuffer<"u"&&t instanceof SharedArrayBuffer){let h=t,u=0,f=t.byteLength;if(typeof e=="object"&&e!==null)a=e;else if(typeof e=="number"){if(u=e,!Number.isSafeInteger(u))throw new RangeError("'byteOffset' must be an integer.");if(u<0||u>=h.byteLength)throw new RangeError(`'byteOffset' is out of range [0, ${h.byteLength}).`);if(f=t.byteLength-u,typeof n=="number"){if(f=n,!Number.isSafeInteger(f))throw new RangeError("'byteLength' must be an integer.");if(f<=0||u+f>h.byteLength)throw new RangeError(`'byteLength' is out of range (0, ${h.byteLength-u}].`);if(typeof s=="object"&&s!==null)a=s;else if(typeof s<"u")throw new TypeError("'options' must be an object.")}else if(typeof n<"u")throw new TypeError("'byteLength' must be a number.")}else if(typeof e<"u")throw new TypeError("'options' must be an object.");r=new Uint8Array(h,u,f)}else throw new TypeError("Unexpected argument[0]: must be 'path' or 'buffer'.");let[o,l]=await Zd(a),c=await o.createInferenceSessionHandler(r,l);return sr("InferenceSession.create"),nr(),new fp(c)}startProfiling(){this.handler.startProfiling()}endProfiling(){this.handler.endProfiling()}get inputNames(){return this.handler.inputNames}get outputNames(){return this.handler.outputNames}get inputMetadata(){return this.handler.inputMetadata}get outputMetadata(){return this.handler.outputMetadata}}}),ko,$_=de(()=>{"use strict";X_(),ko=up}),q_=de(()=>{"use strict"}),Y_=de(()=>{"use strict"}),Z_=de(()=>{"use strict"}),J_=de(()=>{"use strict"}),K_={};Bo(K_,{InferenceSession:()=>ko,TRACE:()=>Wh,TRACE_EVENT_BEGIN:()=>ir,TRACE_EVENT_END:()=>sr,TRACE_FUNC_BEGIN:()=>er,TRACE_FUNC_END:()=>nr,Tensor:()=>on,env:()=>Re,registerBackend:()=>Oo});var Ts=de(()=>{"use strict";B_(),z_(),$_(),cp(),q_(),Y_(),hp(),Z_(),J_()}),Jh=de(()=>{"use strict"}),dp={};Bo(dp,{default:()=>pp});var Ph,Ih,pp,j_=de(()=>{"use strict";Tp(),rr(),Kh(),Ph="ort-wasm-proxy-worker",Ih=globalThis.self?.name===Ph,Ih&&(self.onmessage=i=>{let{type:t,in:e}=i.data;try{switch(t){case"init-wasm":jh(e.wasm).then(()=>{iu(e).then(()=>{postMessage({type:t})},n=>{postMessage({type:t,err:n})})},n=>{postMessage({type:t,err:n})});break;case"init-ep":{let{epName:n,env:s}=e;su(s,n).then(()=>{postMessage({type:t})},r=>{postMessage({type:t,err:r})});break}case"copy-from":{let{buffer:n}=e,s=Fo(n);postMessage({type:t,out:s});break}case"create":{let{model:n,options:s}=e;ru(n,s).then(r=>{postMessage({type:t,out:r})},r=>{postMessage({type:t,err:r})});break}case"release":au(e),postMessage({type:t});break;case"run":{let{sessionId:n,inputIndices:s,inputs:r,outputIndices:a,options:o}=e;ou(n,s,r,a,new Array(a.length).fill(null),o).then(l=>{l.some(c=>c[3]!=="cpu")?postMessage({type:t,err:"Proxy does not support non-cpu tensor location."}):postMessage({type:t,out:l},cu([...r,...l]))},l=>{postMessage({type:t,err:l})});break}case"end-profiling":lu(e),postMessage({type:t});break;default:}}catch(n){postMessage({type:t,err:n})}}),pp=Ih?null:i=>new Worker(i??kn,{type:"module",name:Ph})}),mp={};Bo(mp,{default:()=>gp});var Lh,gp,Nd,Q_=de(()=>{"use strict";Lh=async function(i={}){var t,e,n=i,s=new Promise((v,R)=>{t=v,e=R}),r=typeof window=="object",a=typeof WorkerGlobalScope<"u",o=a&&self.name?.startsWith("em-pthread");n.mountExternalData=(v,R)=>{v.startsWith("./")&&(v=v.substring(2)),(n.Sa||(n.Sa=new Map)).set(v,R)},n.unmountExternalData=()=>{delete n.Sa};var l,c,h=globalThis.SharedArrayBuffer??new WebAssembly.Memory({initial:0,maximum:0,kb:!0}).buffer.constructor,u=(v,R)=>{throw R},f=studioAddress,d="";if(r||a){try{d=new URL(".",f).href}catch{}a&&(c=v=>{var R=new XMLHttpRequest;return R.open("GET",v,!1),R.responseType="arraybuffer",R.send(null),new Uint8Array(R.response)}),l=async v=>{if(tt(v))return new Promise((U,Y)=>{var K=new XMLHttpRequest;K.open("GET",v,!0),K.responseType="arraybuffer",K.onload=()=>{K.status==200||K.status==0&&K.response?U(K.response):Y(K.status)},K.onerror=Y,K.send(null)});var R=await fetch(v,{credentials:"same-origin"});if(R.ok)return R.arrayBuffer();throw Error(R.status+" : "+R.url)}}var m,_,p,g,y,w,b,E,T,x,A,F,L,O=console.log.bind(console),H=console.error.bind(console),Z=O,P=H,W=!1,tt=v=>v.startsWith("file://");function $(){return _.buffer!=y.buffer&&_t(),y}function at(){return _.buffer!=y.buffer&&_t(),w}function X(){return _.buffer!=y.buffer&&_t(),b}function k(){return _.buffer!=y.buffer&&_t(),E}function it(){return _.buffer!=y.buffer&&_t(),T}function Tt(){return _.buffer!=y.buffer&&_t(),x}function kt(){return _.buffer!=y.buffer&&_t(),F}if(o){let v=function(R){try{var U=R.data,Y=U.Ra;if(Y==="load"){let K=[];self.onmessage=vt=>K.push(vt),self.startWorker=()=>{postMessage({Ra:"loaded"});for(let vt of K)v(vt);self.onmessage=v};for(let vt of U.Za)n[vt]&&!n[vt].proxy||(n[vt]=(...Vt)=>{postMessage({Ra:"callHandler",Ya:vt,args:Vt})},vt=="print"&&(Z=n[vt]),vt=="printErr"&&(P=n[vt]));_=U.fb,_t(),L(U.gb)}else if(Y==="run"){C(U.Qa),bh(U.Qa,0,0,1,0,0),Mt(),xs(U.Qa),pt||=!0;try{G(U.bb,U.Va)}catch(K){if(K!="unwind")throw K}}else U.target!=="setimmediate"&&(Y==="checkMailbox"?pt&&Zs():Y&&(P(`worker: received unknown command ${Y}`),P(U)))}catch(K){throw Ad(),K}};var et=v,pt=!1;self.onunhandledrejection=R=>{throw R.reason||R},self.onmessage=v}function _t(){var v=_.buffer;n.HEAP8=y=new Int8Array(v),b=new Int16Array(v),n.HEAPU8=w=new Uint8Array(v),new Uint16Array(v),n.HEAP32=E=new Int32Array(v),n.HEAPU32=T=new Uint32Array(v),x=new Float32Array(v),F=new Float64Array(v),A=new BigInt64Array(v),new BigUint64Array(v)}function Nt(){o?startWorker(n):Wt.$()}var lt,At=0,ae=null;function Ft(){if(--At==0&&ae){var v=ae;ae=null,v()}}function ee(v){throw P(v="Aborted("+v+")"),W=!0,v=new WebAssembly.RuntimeError(v+". Build with -sASSERTIONS for more info."),e(v),v}function _e(){return{a:{j:To,b:st,E:yt,f:I,U:nt,A:J,C:mt,V:ht,S:dt,L:Dt,R:Kt,n:ct,B:Ot,y:Zt,T:bt,z:me,_:Ve,O:gi,w:bo,F:Ci,t:Qr,i:wo,N:xs,X:So,I:Ks,J:xh,K:Eo,G:na,H:Ao,u:ia,q:N,Z:V,o:Rt,k:xt,Y:q,d:wt,W:Lt,x:Xt,c:vh,e:ne,h:Ct,v:ie,s:sn,r:Pt,P:Ye,Q:ai,D:pn,g:yi,m:le,M:He,l:Ce,a:_,p:Be}}}class Qt{name="ExitStatus";constructor(R){this.message=`Program terminated with exit(${R})`,this.status=R}}var Ge=v=>{v.terminate(),v.onmessage=()=>{}},Ue=[],fn=v=>{ze.length==0&&(Bt(),ke(ze[0]));var R=ze.pop();if(!R)return 6;D.push(R),pe[v.Qa]=R,R.Qa=v.Qa;var U={Ra:"run",bb:v.ab,Va:v.Va,Qa:v.Qa};return R.postMessage(U,v.Xa),0},ye=0,oe=(v,R,...U)=>{for(var Y=2*U.length,K=Eh(),vt=Sh(8*Y),Vt=vt>>>3,Fe=0;Fe<U.length;Fe++){var rn=U[Fe];typeof rn=="bigint"?(A[Vt+2*Fe]=1n,A[Vt+2*Fe+1]=rn):(A[Vt+2*Fe]=0n,kt()[Vt+2*Fe+1>>>0]=rn)}return v=Td(v,0,Y,vt,R),Ro(K),v};function Be(v){if(o)return oe(0,1,v);if(g=v,!(0<ye)){for(var R of D)Ge(R);for(R of ze)Ge(R);ze=[],D=[],pe={},W=!0}u(0,new Qt(v))}function Mn(v){if(o)return oe(1,0,v);pn(v)}var pn=v=>{if(g=v,o)throw Mn(v),"unwind";Be(v)},ze=[],D=[],bn=[],pe={},Ae=v=>{var R=v.Qa;delete pe[R],ze.push(v),D.splice(D.indexOf(v),1),v.Qa=0,Rd(R)};function Mt(){bn.forEach(v=>v())}var ke=v=>new Promise(R=>{v.onmessage=K=>{var vt=(K=K.data).Ra;if(K.Ta&&K.Ta!=Mh()){var Vt=pe[K.Ta];Vt?Vt.postMessage(K,K.Xa):P(`Internal error! Worker sent a message "${vt}" to target pthread ${K.Ta}, but that thread no longer exists!`)}else vt==="checkMailbox"?Zs():vt==="spawnThread"?fn(K):vt==="cleanupThread"?Ae(pe[K.cb]):vt==="loaded"?(v.loaded=!0,R(v)):K.target==="setimmediate"?v.postMessage(K):vt==="callHandler"?n[K.Ya](...K.args):vt&&P(`worker sent an unknown command ${vt}`)},v.onerror=K=>{throw P(`worker sent an error! ${K.filename}:${K.lineno}: ${K.message}`),K};var U,Y=[];for(U of[])n.propertyIsEnumerable(U)&&Y.push(U);v.postMessage({Ra:"load",Za:Y,fb:_,gb:p})});function Bt(){var v=new Worker((()=>{let R=URL;return studioAddress>"file:"&&studioAddress<"file;"?new R("ort.wasm.bundle.min.mjs",studioAddress):new URL(studioAddress)})(),{type:"module",workerData:"em-pthread",name:"em-pthread"});ze.push(v)}var Gt,C=v=>{_t();var R=it()[v+52>>>2>>>0];v=it()[v+56>>>2>>>0],Id(R,R-v),Ro(R)},M=[],G=(v,R)=>{ye=0;var U=M[v];U||(M[v]=U=Gt.get(v)),v=U(R),0<ye?g=v:wh(v)};class ot{constructor(R){this.Ua=R-24}}function st(v,R,U){var Y=new ot(v>>>=0);throw R>>>=0,U>>>=0,it()[Y.Ua+16>>>2>>>0]=0,it()[Y.Ua+4>>>2>>>0]=R,it()[Y.Ua+8>>>2>>>0]=U,v}function ut(v,R,U,Y){return o?oe(2,1,v,R,U,Y):yt(v,R,U,Y)}function yt(v,R,U,Y){if(v>>>=0,U>>>=0,Y>>>=0,h===void 0)return 6;var K=[];return o&&K.length===0?ut(v,R>>>=0,U,Y):(v={ab:U,Qa:v,Va:Y,Xa:K},o?(v.Ra="spawnThread",postMessage(v,K),0):fn(v))}var j=typeof TextDecoder<"u"?new TextDecoder:void 0,Q=(v,R=0,U=NaN)=>{var Y=(R>>>=0)+U;for(U=R;v[U]&&!(U>=Y);)++U;if(16<U-R&&v.buffer&&j)return j.decode(v.buffer instanceof ArrayBuffer?v.subarray(R,U):v.slice(R,U));for(Y="";R<U;){var K=v[R++];if(128&K){var vt=63&v[R++];if((224&K)==192)Y+=String.fromCharCode((31&K)<<6|vt);else{var Vt=63&v[R++];65536>(K=(240&K)==224?(15&K)<<12|vt<<6|Vt:(7&K)<<18|vt<<12|Vt<<6|63&v[R++])?Y+=String.fromCharCode(K):(K-=65536,Y+=String.fromCharCode(55296|K>>10,56320|1023&K))}}else Y+=String.fromCharCode(K)}return Y},ft=(v,R)=>(v>>>=0)?Q(at(),v,R):"";function I(v,R,U){return o?oe(3,1,v,R,U):0}function nt(v,R){if(o)return oe(4,1,v,R)}function J(v,R){if(o)return oe(5,1,v,R)}function mt(v,R,U){if(o)return oe(6,1,v,R,U)}function ht(v,R,U){return o?oe(7,1,v,R,U):0}function dt(v,R){if(o)return oe(8,1,v,R)}function Dt(v,R,U){if(o)return oe(9,1,v,R,U)}function Kt(v,R,U,Y){if(o)return oe(10,1,v,R,U,Y)}function ct(v,R,U,Y){if(o)return oe(11,1,v,R,U,Y)}function Ot(v,R,U,Y){if(o)return oe(12,1,v,R,U,Y)}function Zt(v){if(o)return oe(13,1,v)}function bt(v,R){if(o)return oe(14,1,v,R)}function me(v,R,U){if(o)return oe(15,1,v,R,U)}var Ve=()=>ee("");function gi(v){bh(v>>>0,!a,1,!r,131072,!1),Mt()}var jr=v=>{if(!W)try{if(v(),!(0<ye))try{o?wh(g):pn(g)}catch(R){R instanceof Qt||R=="unwind"||u(0,R)}}catch(R){R instanceof Qt||R=="unwind"||u(0,R)}};function xs(v){v>>>=0,typeof Atomics.eb=="function"&&(Atomics.eb(k(),v>>>2,v).value.then(Zs),v+=128,Atomics.store(k(),v>>>2,1))}var Zs=()=>{var v=Mh();v&&(xs(v),jr(Pd))};function bo(v,R){(v>>>=0)==R>>>0?setTimeout(Zs):o?postMessage({Ta:v,Ra:"checkMailbox"}):(v=pe[v])&&v.postMessage({Ra:"checkMailbox"})}var Js=[];function Ci(v,R,U,Y,K){for(R>>>=0,Y/=2,Js.length=Y,U=K>>>0>>>3,K=0;K<Y;K++)Js[K]=A[U+2*K]?A[U+2*K+1]:kt()[U+2*K+1>>>0];return(R?Yn[R]:We[v])(...Js)}var Qr=()=>{ye=0};function wo(v){v>>>=0,o?postMessage({Ra:"cleanupThread",cb:v}):Ae(pe[v])}function So(v){}function Ks(v,R){v=-9007199254740992>v||9007199254740992<v?NaN:Number(v),R>>>=0,v=new Date(1e3*v),k()[R>>>2>>>0]=v.getUTCSeconds(),k()[R+4>>>2>>>0]=v.getUTCMinutes(),k()[R+8>>>2>>>0]=v.getUTCHours(),k()[R+12>>>2>>>0]=v.getUTCDate(),k()[R+16>>>2>>>0]=v.getUTCMonth(),k()[R+20>>>2>>>0]=v.getUTCFullYear()-1900,k()[R+24>>>2>>>0]=v.getUTCDay(),v=(v.getTime()-Date.UTC(v.getUTCFullYear(),0,1,0,0,0,0))/864e5|0,k()[R+28>>>2>>>0]=v}var ta=v=>v%4==0&&(v%100!=0||v%400==0),ea=[0,31,60,91,121,152,182,213,244,274,305,335],Ji=[0,31,59,90,120,151,181,212,243,273,304,334];function xh(v,R){v=-9007199254740992>v||9007199254740992<v?NaN:Number(v),R>>>=0,v=new Date(1e3*v),k()[R>>>2>>>0]=v.getSeconds(),k()[R+4>>>2>>>0]=v.getMinutes(),k()[R+8>>>2>>>0]=v.getHours(),k()[R+12>>>2>>>0]=v.getDate(),k()[R+16>>>2>>>0]=v.getMonth(),k()[R+20>>>2>>>0]=v.getFullYear()-1900,k()[R+24>>>2>>>0]=v.getDay();var U=(ta(v.getFullYear())?ea:Ji)[v.getMonth()]+v.getDate()-1|0;k()[R+28>>>2>>>0]=U,k()[R+36>>>2>>>0]=-60*v.getTimezoneOffset(),U=new Date(v.getFullYear(),6,1).getTimezoneOffset();var Y=new Date(v.getFullYear(),0,1).getTimezoneOffset();v=0|(U!=Y&&v.getTimezoneOffset()==Math.min(Y,U)),k()[R+32>>>2>>>0]=v}function Eo(v){v>>>=0;var R=new Date(k()[v+20>>>2>>>0]+1900,k()[v+16>>>2>>>0],k()[v+12>>>2>>>0],k()[v+8>>>2>>>0],k()[v+4>>>2>>>0],k()[v>>>2>>>0],0),U=k()[v+32>>>2>>>0],Y=R.getTimezoneOffset(),K=new Date(R.getFullYear(),6,1).getTimezoneOffset(),vt=new Date(R.getFullYear(),0,1).getTimezoneOffset(),Vt=Math.min(vt,K);return 0>U?k()[v+32>>>2>>>0]=+(K!=vt&&Vt==Y):0<U!=(Vt==Y)&&(K=Math.max(vt,K),R.setTime(R.getTime()+6e4*((0<U?Vt:K)-Y))),k()[v+24>>>2>>>0]=R.getDay(),U=(ta(R.getFullYear())?ea:Ji)[R.getMonth()]+R.getDate()-1|0,k()[v+28>>>2>>>0]=U,k()[v>>>2>>>0]=R.getSeconds(),k()[v+4>>>2>>>0]=R.getMinutes(),k()[v+8>>>2>>>0]=R.getHours(),k()[v+12>>>2>>>0]=R.getDate(),k()[v+16>>>2>>>0]=R.getMonth(),k()[v+20>>>2>>>0]=R.getYear(),v=R.getTime(),BigInt(isNaN(v)?-1:v/1e3)}function na(v,R,U,Y,K,vt,Vt){return o?oe(16,1,v,R,U,Y,K,vt,Vt):-52}function Ao(v,R,U,Y,K,vt){if(o)return oe(17,1,v,R,U,Y,K,vt)}var vs={},vh=()=>performance.timeOrigin+performance.now();function ia(v,R){if(o)return oe(18,1,v,R);if(vs[v]&&(clearTimeout(vs[v].id),delete vs[v]),!R)return 0;var U=setTimeout(()=>{delete vs[v],jr(()=>Cd(v,performance.timeOrigin+performance.now()))},R);return vs[v]={id:U,lb:R},0}var S=(v,R,U)=>{var Y=at();if(R>>>=0,0<U){var K=R;U=R+U-1;for(var vt=0;vt<v.length;++vt){var Vt=v.charCodeAt(vt);if(55296<=Vt&&57343>=Vt&&(Vt=65536+((1023&Vt)<<10)|1023&v.charCodeAt(++vt)),127>=Vt){if(R>=U)break;Y[R++>>>0]=Vt}else{if(2047>=Vt){if(R+1>=U)break;Y[R++>>>0]=192|Vt>>6}else{if(65535>=Vt){if(R+2>=U)break;Y[R++>>>0]=224|Vt>>12}else{if(R+3>=U)break;Y[R++>>>0]=240|Vt>>18,Y[R++>>>0]=128|Vt>>12&63}Y[R++>>>0]=128|Vt>>6&63}Y[R++>>>0]=128|63&Vt}}Y[R>>>0]=0,v=R-K}else v=0;return v};function N(v,R,U,Y){v>>>=0,R>>>=0,U>>>=0,Y>>>=0;var K=new Date().getFullYear(),vt=new Date(K,0,1).getTimezoneOffset();K=new Date(K,6,1).getTimezoneOffset();var Vt=Math.max(vt,K);it()[v>>>2>>>0]=60*Vt,k()[R>>>2>>>0]=+(vt!=K),v=(R=Fe=>{var rn=Math.abs(Fe);return`UTC${0<=Fe?"-":"+"}${String(Math.floor(rn/60)).padStart(2,"0")}${String(rn%60).padStart(2,"0")}`})(vt),R=R(K),K<vt?(S(v,U,17),S(R,Y,17)):(S(v,Y,17),S(R,U,17))}var q=()=>Date.now(),z=1;function V(v,R,U){if(!(0<=v&&3>=v))return 28;if(v===0)v=Date.now();else{if(!z)return 52;v=performance.timeOrigin+performance.now()}return A[U>>>0>>>3]=BigInt(Math.round(1e6*v)),0}var gt=[];function Rt(v,R,U){v>>>=0,R>>>=0,U>>>=0,gt.length=0;for(var Y;Y=at()[R++>>>0];){var K=Y!=105;U+=(K&=Y!=112)&&U%8?4:0,gt.push(Y==112?it()[U>>>2>>>0]:Y==106?A[U>>>3]:Y==105?k()[U>>>2>>>0]:kt()[U>>>3>>>0]),U+=K?8:4}return Yn[v](...gt)}var xt=()=>{};function wt(v,R){return P(ft(v>>>0,R>>>0))}var Lt=()=>{throw ye+=1,"unwind"};function Xt(){return 4294901760}var ne=()=>navigator.hardwareConcurrency;function Ct(){return ee("Cannot use emscripten_pc_get_function without -sUSE_OFFSET_CONVERTER"),0}function ie(v){v>>>=0;var R=at().length;if(v<=R||4294901760<v)return!1;for(var U=1;4>=U;U*=2){var Y=R*(1+.2/U);Y=Math.min(Y,v+100663296);t:{Y=(Math.min(4294901760,65536*Math.ceil(Math.max(v,Y)/65536))-_.buffer.byteLength+65535)/65536|0;try{_.grow(Y),_t();var K=1;break t}catch{}K=void 0}if(K)return!0}return!1}var Ie=()=>(ee("Cannot use convertFrameToPC (needed by __builtin_return_address) without -sUSE_OFFSET_CONVERTER"),0),fe={},xe=v=>{v.forEach(R=>{var U=Ie();U&&(fe[U]=R)})};function sn(){var v=Error().stack.toString().split(`
`);return v[0]=="Error"&&v.shift(),xe(v),fe.Wa=Ie(),fe.$a=v,fe.Wa}function Pt(v,R,U){if(v>>>=0,R>>>=0,fe.Wa==v)var Y=fe.$a;else(Y=Error().stack.toString().split(`
`))[0]=="Error"&&Y.shift(),xe(Y);for(var K=3;Y[K]&&Ie()!=v;)++K;for(v=0;v<U&&Y[v+K];++v)k()[R+4*v>>>2>>>0]=Ie();return v}var qe,he={},_i=()=>{if(!qe){var v,R={USER:"web_user",LOGNAME:"web_user",PATH:"/",PWD:"/",HOME:"/home/web_user",LANG:(typeof navigator=="object"&&navigator.languages&&navigator.languages[0]||"C").replace("-","_")+".UTF-8",_:"./this.program"};for(v in he)he[v]===void 0?delete R[v]:R[v]=he[v];var U=[];for(v in R)U.push(`${v}=${R[v]}`);qe=U}return qe};function Ye(v,R){if(o)return oe(19,1,v,R);v>>>=0,R>>>=0;var U,Y=0,K=0;for(U of _i()){var vt=R+Y;it()[v+K>>>2>>>0]=vt,Y+=S(U,vt,1/0)+1,K+=4}return 0}var Ms=v=>{for(var R=0,U=0;U<v.length;++U){var Y=v.charCodeAt(U);127>=Y?R++:2047>=Y?R+=2:55296<=Y&&57343>=Y?(R+=4,++U):R+=3}return R};function ai(v,R){if(o)return oe(20,1,v,R);v>>>=0,R>>>=0;var U=_i();for(var Y of(it()[v>>>2>>>0]=U.length,v=0,U))v+=Ms(Y)+1;return it()[R>>>2>>>0]=v,0}function yi(v){return o?oe(21,1,v):52}function le(v,R,U,Y){return o?oe(22,1,v,R,U,Y):52}function He(v,R,U,Y){return o?oe(23,1,v,R,U,Y):70}var Bn=[null,[],[]];function Ce(v,R,U,Y){if(o)return oe(24,1,v,R,U,Y);R>>>=0,U>>>=0,Y>>>=0;for(var K=0,vt=0;vt<U;vt++){var Vt=it()[R>>>2>>>0],Fe=it()[R+4>>>2>>>0];R+=8;for(var rn=0;rn<Fe;rn++){var mn=v,sa=at()[Vt+rn>>>0],Ah=Bn[mn];sa===0||sa===10?((mn===1?Z:P)(Q(Ah)),Ah.length=0):Ah.push(sa)}K+=Fe}return it()[Y>>>2>>>0]=K,0}o||(function(){for(var v=n.numThreads-1;v--;)Bt();Ue.push(()=>{At++,(function(R){o?R():Promise.all(ze.map(ke)).then(R)})(()=>Ft())})})(),o||(_=new WebAssembly.Memory({initial:256,maximum:65536,shared:!0}),_t()),n.wasmBinary&&(m=n.wasmBinary),n.stackSave=()=>Eh(),n.stackRestore=v=>Ro(v),n.stackAlloc=v=>Sh(v),n.setValue=function(v,R,U="i8"){switch(U.endsWith("*")&&(U="*"),U){case"i1":case"i8":$()[v>>>0]=R;break;case"i16":X()[v>>>1>>>0]=R;break;case"i32":k()[v>>>2>>>0]=R;break;case"i64":A[v>>>3]=BigInt(R);break;case"float":Tt()[v>>>2>>>0]=R;break;case"double":kt()[v>>>3>>>0]=R;break;case"*":it()[v>>>2>>>0]=R;break;default:ee(`invalid type for setValue: ${U}`)}},n.getValue=function(v,R="i8"){switch(R.endsWith("*")&&(R="*"),R){case"i1":case"i8":return $()[v>>>0];case"i16":return X()[v>>>1>>>0];case"i32":return k()[v>>>2>>>0];case"i64":return A[v>>>3];case"float":return Tt()[v>>>2>>>0];case"double":return kt()[v>>>3>>>0];case"*":return it()[v>>>2>>>0];default:ee(`invalid type for getValue: ${R}`)}},n.UTF8ToString=ft,n.stringToUTF8=S,n.lengthBytesUTF8=Ms;var We=[Be,Mn,ut,I,nt,J,mt,ht,dt,Dt,Kt,ct,Ot,Zt,bt,me,na,Ao,ia,Ye,ai,yi,le,He,Ce],Yn={853836:(v,R,U,Y,K)=>{if(n===void 0||!n.Sa)return 1;if((v=ft(Number(v>>>0))).startsWith("./")&&(v=v.substring(2)),!(v=n.Sa.get(v)))return 2;if(R=Number(R>>>0),U=Number(U>>>0),Y=Number(Y>>>0),R+U>v.byteLength)return 3;try{let vt=v.subarray(R,R+U);switch(K){case 0:at().set(vt,Y>>>0);break;case 1:n.hb?n.hb(Y,vt):n.jb(Y,vt);break;default:return 4}return 0}catch{return 4}},854660:()=>typeof wasmOffsetConverter<"u"};function To(){return typeof wasmOffsetConverter<"u"}var Wt=await(async function(){function v(Y,K){return Wt=Y.exports,Wt=(function(){var vt=Wt,Vt=rn=>()=>rn()>>>0,Fe=rn=>mn=>rn(mn)>>>0;return(vt=Object.assign({},vt)).Aa=Vt(vt.Aa),vt.Ca=Fe(vt.Ca),vt.Oa=Fe(vt.Oa),vt.Pa=Vt(vt.Pa),vt.__cxa_get_exception_ptr=Fe(vt.__cxa_get_exception_ptr),vt})(),bn.push(Wt.Da),Gt=Wt.Ea,p=K,Ft(),Wt}At++;var R=_e();if(n.instantiateWasm)return new Promise(Y=>{n.instantiateWasm(R,(K,vt)=>{Y(v(K,vt))})});if(o)return new Promise(Y=>{L=K=>{var vt=new WebAssembly.Instance(K,_e());Y(v(vt,K))}});lt??=n.locateFile?n.locateFile?n.locateFile("ort-wasm-simd-threaded.wasm",d):d+"ort-wasm-simd-threaded.wasm":new URL("ort-wasm-simd-threaded.wasm",studioAddress).href;try{var U=await(async function(Y){var K=lt;if(!m&&typeof WebAssembly.instantiateStreaming=="function"&&!tt(K))try{var vt=fetch(K,{credentials:"same-origin"});return await WebAssembly.instantiateStreaming(vt,Y)}catch(Vt){P(`wasm streaming compile failed: ${Vt}`),P("falling back to ArrayBuffer instantiation")}return(async function(Vt,Fe){try{var rn=await(async function(mn){if(!m)try{var sa=await l(mn);return new Uint8Array(sa)}catch{}if(mn==lt&&m)mn=new Uint8Array(m);else{if(!c)throw"both async and sync fetching of the wasm failed";mn=c(mn)}return mn})(Vt);return await WebAssembly.instantiate(rn,Fe)}catch(mn){P(`failed to asynchronously prepare wasm: ${mn}`),ee(mn)}})(K,Y)})(R);return v(U.instance,U.module)}catch(Y){return e(Y),Promise.reject(Y)}})();n._OrtInit=(v,R)=>(n._OrtInit=Wt.aa)(v,R),n._OrtGetLastError=(v,R)=>(n._OrtGetLastError=Wt.ba)(v,R),n._OrtCreateSessionOptions=(v,R,U,Y,K,vt,Vt,Fe,rn,mn)=>(n._OrtCreateSessionOptions=Wt.ca)(v,R,U,Y,K,vt,Vt,Fe,rn,mn),n._OrtAppendExecutionProvider=(v,R,U,Y,K)=>(n._OrtAppendExecutionProvider=Wt.da)(v,R,U,Y,K),n._OrtAddFreeDimensionOverride=(v,R,U)=>(n._OrtAddFreeDimensionOverride=Wt.ea)(v,R,U),n._OrtAddSessionConfigEntry=(v,R,U)=>(n._OrtAddSessionConfigEntry=Wt.fa)(v,R,U),n._OrtReleaseSessionOptions=v=>(n._OrtReleaseSessionOptions=Wt.ga)(v),n._OrtCreateSession=(v,R,U)=>(n._OrtCreateSession=Wt.ha)(v,R,U),n._OrtReleaseSession=v=>(n._OrtReleaseSession=Wt.ia)(v),n._OrtGetInputOutputCount=(v,R,U)=>(n._OrtGetInputOutputCount=Wt.ja)(v,R,U),n._OrtGetInputOutputMetadata=(v,R,U,Y)=>(n._OrtGetInputOutputMetadata=Wt.ka)(v,R,U,Y),n._OrtFree=v=>(n._OrtFree=Wt.la)(v),n._OrtCreateTensor=(v,R,U,Y,K,vt)=>(n._OrtCreateTensor=Wt.ma)(v,R,U,Y,K,vt),n._OrtGetTensorData=(v,R,U,Y,K)=>(n._OrtGetTensorData=Wt.na)(v,R,U,Y,K),n._OrtReleaseTensor=v=>(n._OrtReleaseTensor=Wt.oa)(v),n._OrtCreateRunOptions=(v,R,U,Y)=>(n._OrtCreateRunOptions=Wt.pa)(v,R,U,Y),n._OrtAddRunConfigEntry=(v,R,U)=>(n._OrtAddRunConfigEntry=Wt.qa)(v,R,U),n._OrtReleaseRunOptions=v=>(n._OrtReleaseRunOptions=Wt.ra)(v),n._OrtCreateBinding=v=>(n._OrtCreateBinding=Wt.sa)(v),n._OrtBindInput=(v,R,U)=>(n._OrtBindInput=Wt.ta)(v,R,U),n._OrtBindOutput=(v,R,U,Y)=>(n._OrtBindOutput=Wt.ua)(v,R,U,Y),n._OrtClearBoundOutputs=v=>(n._OrtClearBoundOutputs=Wt.va)(v),n._OrtReleaseBinding=v=>(n._OrtReleaseBinding=Wt.wa)(v),n._OrtRunWithBinding=(v,R,U,Y,K)=>(n._OrtRunWithBinding=Wt.xa)(v,R,U,Y,K),n._OrtRun=(v,R,U,Y,K,vt,Vt,Fe)=>(n._OrtRun=Wt.ya)(v,R,U,Y,K,vt,Vt,Fe),n._OrtEndProfiling=v=>(n._OrtEndProfiling=Wt.za)(v);var Mh=()=>(Mh=Wt.Aa)();n._free=v=>(n._free=Wt.Ba)(v),n._malloc=v=>(n._malloc=Wt.Ca)(v);var bh=(v,R,U,Y,K,vt)=>(bh=Wt.Fa)(v,R,U,Y,K,vt),Ad=()=>(Ad=Wt.Ga)(),Td=(v,R,U,Y,K)=>(Td=Wt.Ha)(v,R,U,Y,K),Rd=v=>(Rd=Wt.Ia)(v),wh=v=>(wh=Wt.Ja)(v),Cd=(v,R)=>(Cd=Wt.Ka)(v,R),Pd=()=>(Pd=Wt.La)(),Id=(v,R)=>(Id=Wt.Ma)(v,R),Ro=v=>(Ro=Wt.Na)(v),Sh=v=>(Sh=Wt.Oa)(v),Eh=()=>(Eh=Wt.Pa)();return(function v(){if(0<At)ae=v;else if(o)t(n),Nt();else{for(;0<Ue.length;)Ue.shift()(n);0<At?ae=v:(n.calledRun=!0,W||(Nt(),t(n)))}})(),n.PTR_SIZE=4,s},gp=Lh,Nd=globalThis.self?.name?.startsWith("em-pthread"),Nd&&Lh()}),Nh,Xh,Dd,kn,_p,Po,Od,Ud,Dh,Fd,Oh,yp,Uh,xp,Kh=de(()=>{"use strict";Jh(),Nh=typeof location>"u"?void 0:studioOrigin,Xh=studioAddress>"file:"&&studioAddress<"file;",Dd=()=>{if(Xh){let i=URL;return new URL(new i("ort.wasm.bundle.min.mjs",studioAddress).href,Nh).href}return studioAddress},kn=Dd(),_p=()=>{if(kn&&!kn.startsWith("blob:"))return kn.substring(0,kn.lastIndexOf("/")+1)},Po=(i,t)=>{try{let e=t??kn;return(e?new URL(i,e):new URL(i)).origin===Nh}catch{return!1}},Od=(i,t)=>{let e=t??kn;try{return(e?new URL(i,e):new URL(i)).href}catch{return}},Ud=(i,t)=>`${t??"./"}${i}`,Dh=async i=>{let t=await(await fetch(i,{credentials:"same-origin"})).blob();return URL.createObjectURL(t)},Fd=async i=>(await import(i)).default,Oh=(j_(),Hh(dp)).default,yp=async()=>{if(!kn)throw new Error("Failed to load proxy worker: cannot determine the script source URL.");if(Po(kn))return[void 0,Oh()];let i=await Dh(kn);return[i,Oh(i)]},Uh=(Q_(),Hh(mp)).default,xp=async(i,t,e,n)=>{let s=Uh&&!(i||t);if(s)if(kn)s=Po(kn);else if(n&&!e)s=!0;else throw new Error("cannot determine the script source URL.");if(s)return[void 0,Uh];{let r="ort-wasm-simd-threaded.mjs",a=i??Od(r,t),o=e&&a&&!Po(a,t),l=o?await Dh(a):a??Ud(r,t);return[o?l:void 0,await Fd(l)]}}}),Fh,Io,aa,Bh,Bd,kd,zd,jh,Le,rr=de(()=>{"use strict";Kh(),Io=!1,aa=!1,Bh=!1,Bd=()=>{if(typeof SharedArrayBuffer>"u")return!1;try{return typeof MessageChannel<"u"&&new MessageChannel().port1.postMessage(new SharedArrayBuffer(1)),WebAssembly.validate(new Uint8Array([0,97,115,109,1,0,0,0,1,4,1,96,0,0,3,2,1,0,5,4,1,3,1,1,10,11,1,9,0,65,0,254,16,2,0,26,11]))}catch{return!1}},kd=()=>{try{return WebAssembly.validate(new Uint8Array([0,97,115,109,1,0,0,0,1,4,1,96,0,0,3,2,1,0,10,30,1,28,0,65,0,253,15,253,12,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,253,186,1,26,11]))}catch{return!1}},zd=()=>{try{return WebAssembly.validate(new Uint8Array([0,97,115,109,1,0,0,0,1,5,1,96,0,1,123,3,2,1,0,10,19,1,17,0,65,1,253,15,65,2,253,15,65,3,253,15,253,147,2,11]))}catch{return!1}},jh=async i=>{if(Io)return Promise.resolve();if(aa)throw new Error("multiple calls to 'initializeWebAssembly()' detected.");if(Bh)throw new Error("previous call to 'initializeWebAssembly()' failed.");aa=!0;let t=i.initTimeout,e=i.numThreads;if(i.simd!==!1){if(i.simd==="relaxed"){if(!zd())throw new Error("Relaxed WebAssembly SIMD is not supported in the current environment.")}else if(!kd())throw new Error("WebAssembly SIMD is not supported in the current environment.")}let n=Bd();e>1&&!n&&(typeof self<"u"&&!self.crossOriginIsolated&&console.warn("env.wasm.numThreads is set to "+e+", but this will not work unless you enable crossOriginIsolated mode. See https://web.dev/cross-origin-isolation-guide/ for more info."),console.warn("WebAssembly multi-threading is not supported in the current environment. Falling back to single-threading."),i.numThreads=e=1);let s=i.wasmPaths,r=typeof s=="string"?s:void 0,a=s?.mjs,o=a?.href??a,l=s?.wasm,c=l?.href??l,h=i.wasmBinary,[u,f]=await xp(o,r,e>1,!!h||!!c),d=!1,m=[];if(t>0&&m.push(new Promise(_=>{setTimeout(()=>{d=!0,_()},t)})),m.push(new Promise((_,p)=>{let g={numThreads:e};if(h)g.wasmBinary=h;else if(c||r)g.locateFile=y=>c??r+y;else if(o&&o.indexOf("blob:")!==0)g.locateFile=y=>new URL(y,o).href;else if(u){let y=_p();y&&(g.locateFile=w=>y+w)}f(g).then(y=>{aa=!1,Io=!0,Fh=y,_(),u&&URL.revokeObjectURL(u)},y=>{aa=!1,Bh=!0,p(y)})})),await Promise.race(m),d)throw new Error(`WebAssembly backend initializing failed due to timeout: ${t}ms`)},Le=()=>{if(Io&&Fh)return Fh;throw new Error("WebAssembly is not initialized yet.")}}),oi,Uo,Te,Qh=de(()=>{"use strict";rr(),oi=(i,t)=>{let e=Le(),n=e.lengthBytesUTF8(i)+1,s=e._malloc(n);return e.stringToUTF8(i,s,n),t.push(s),s},Uo=(i,t,e,n)=>{if(typeof i=="object"&&i!==null){if(e.has(i))throw new Error("Circular reference in options");e.add(i)}Object.entries(i).forEach(([s,r])=>{let a=t?t+s:s;if(typeof r=="object")Uo(r,a+".",e,n);else if(typeof r=="string"||typeof r=="number")n(a,r.toString());else if(typeof r=="boolean")n(a,r?"1":"0");else throw new Error(`Can't handle extra config type: ${typeof r}`)})},Te=i=>{let t=Le(),e=t.stackSave();try{let n=t.PTR_SIZE,s=t.stackAlloc(2*n);t._OrtGetLastError(s,s+n);let r=Number(t.getValue(s,n===4?"i32":"i64")),a=t.getValue(s+n,"*"),o=a?t.UTF8ToString(a):"";throw new Error(`${i} ERROR_CODE: ${r}, ERROR_MESSAGE: ${o}`)}finally{t.stackRestore(e)}}}),vp,ty=de(()=>{"use strict";rr(),Qh(),vp=i=>{let t=Le(),e=0,n=[],s=i||{};try{if(i?.logSeverityLevel===void 0)s.logSeverityLevel=2;else if(typeof i.logSeverityLevel!="number"||!Number.isInteger(i.logSeverityLevel)||i.logSeverityLevel<0||i.logSeverityLevel>4)throw new Error(`log severity level is not valid: ${i.logSeverityLevel}`);if(i?.logVerbosityLevel===void 0)s.logVerbosityLevel=0;else if(typeof i.logVerbosityLevel!="number"||!Number.isInteger(i.logVerbosityLevel))throw new Error(`log verbosity level is not valid: ${i.logVerbosityLevel}`);i?.terminate===void 0&&(s.terminate=!1);let r=0;return i?.tag!==void 0&&(r=oi(i.tag,n)),e=t._OrtCreateRunOptions(s.logSeverityLevel,s.logVerbosityLevel,!!s.terminate,r),e===0&&Te("Can't create run options."),i?.extra!==void 0&&Uo(i.extra,"",new WeakSet,(a,o)=>{let l=oi(a,n),c=oi(o,n);t._OrtAddRunConfigEntry(e,l,c)!==0&&Te(`Can't set a run config entry: ${a} - ${o}.`)}),[e,n]}catch(r){throw e!==0&&t._OrtReleaseRunOptions(e),n.forEach(a=>t._free(a)),r}}}),Gd,Vd,Hd,oa,Wd,Mp,ey=de(()=>{"use strict";rr(),Qh(),Gd=i=>{switch(i){case"disabled":return 0;case"basic":return 1;case"extended":return 2;case"layout":return 3;case"all":return 99;default:throw new Error(`unsupported graph optimization level: ${i}`)}},Vd=i=>{switch(i){case"sequential":return 0;case"parallel":return 1;default:throw new Error(`unsupported execution mode: ${i}`)}},Hd=i=>{i.extra||(i.extra={}),i.extra.session||(i.extra.session={});let t=i.extra.session;t.use_ort_model_bytes_directly||(t.use_ort_model_bytes_directly="1"),i.executionProviders&&i.executionProviders.some(e=>(typeof e=="string"?e:e.name)==="webgpu")&&(i.enableMemPattern=!1)},oa=(i,t,e,n)=>{let s=oi(t,n),r=oi(e,n);Le()._OrtAddSessionConfigEntry(i,s,r)!==0&&Te(`Can't set a session config entry: ${t} - ${e}.`)},Wd=async(i,t,e)=>{for(let n of t){let s=typeof n=="string"?n:n.name,r=[];switch(s){case"webnn":if(s="WEBNN",typeof n!="string"){let h=n?.deviceType;h&&oa(i,"deviceType",h,e)}break;case"webgpu":if(s="JS",typeof n!="string"){let h=n;if(h?.preferredLayout){if(h.preferredLayout!=="NCHW"&&h.preferredLayout!=="NHWC")throw new Error(`preferredLayout must be either 'NCHW' or 'NHWC': ${h.preferredLayout}`);oa(i,"preferredLayout",h.preferredLayout,e)}}break;case"wasm":case"cpu":continue;default:throw new Error(`not supported execution provider: ${s}`)}let a=oi(s,e),o=r.length,l=0,c=0;if(o>0){l=Le()._malloc(o*Le().PTR_SIZE),e.push(l),c=Le()._malloc(o*Le().PTR_SIZE),e.push(c);for(let h=0;h<o;h++)Le().setValue(l+h*Le().PTR_SIZE,r[h][0],"*"),Le().setValue(c+h*Le().PTR_SIZE,r[h][1],"*")}await Le()._OrtAppendExecutionProvider(i,a,l,c,o)!==0&&Te(`Can't append execution provider: ${s}.`)}},Mp=async i=>{let t=Le(),e=0,n=[],s=i||{};Hd(s);try{let r=Gd(s.graphOptimizationLevel??"all"),a=Vd(s.executionMode??"sequential"),o=typeof s.logId=="string"?oi(s.logId,n):0,l=s.logSeverityLevel??2;if(!Number.isInteger(l)||l<0||l>4)throw new Error(`log severity level is not valid: ${l}`);let c=s.logVerbosityLevel??0;if(!Number.isInteger(c)||c<0||c>4)throw new Error(`log verbosity level is not valid: ${c}`);let h=typeof s.optimizedModelFilePath=="string"?oi(s.optimizedModelFilePath,n):0;if(e=t._OrtCreateSessionOptions(r,!!s.enableCpuMemArena,!!s.enableMemPattern,a,!!s.enableProfiling,0,o,l,c,h),e===0&&Te("Can't create session options."),s.executionProviders&&await Wd(e,s.executionProviders,n),s.enableGraphCapture!==void 0){if(typeof s.enableGraphCapture!="boolean")throw new Error(`enableGraphCapture must be a boolean value: ${s.enableGraphCapture}`);oa(e,"enableGraphCapture",s.enableGraphCapture.toString(),n)}if(s.freeDimensionOverrides)for(let[u,f]of Object.entries(s.freeDimensionOverrides)){if(typeof u!="string")throw new Error(`free dimension override name must be a string: ${u}`);if(typeof f!="number"||!Number.isInteger(f)||f<0)throw new Error(`free dimension override value must be a non-negative integer: ${f}`);let d=oi(u,n);t._OrtAddFreeDimensionOverride(e,d,f)!==0&&Te(`Can't set a free dimension override: ${u} - ${f}.`)}return s.extra!==void 0&&Uo(s.extra,"",new WeakSet,(u,f)=>{oa(e,u,f,n)}),[e,n]}catch(r){throw e!==0&&t._OrtReleaseSessionOptions(e)!==0&&Te("Can't release session options."),n.forEach(a=>t._free(a)),r}}}),Qs,Do,tr,bp,wp,tu,eu,Sp,Ep=de(()=>{"use strict";Qs=i=>{switch(i){case"int8":return 3;case"uint8":return 2;case"bool":return 9;case"int16":return 5;case"uint16":return 4;case"int32":return 6;case"uint32":return 12;case"float16":return 10;case"float32":return 1;case"float64":return 11;case"string":return 8;case"int64":return 7;case"uint64":return 13;case"int4":return 22;case"uint4":return 21;default:throw new Error(`unsupported data type: ${i}`)}},Do=i=>{switch(i){case 3:return"int8";case 2:return"uint8";case 9:return"bool";case 5:return"int16";case 4:return"uint16";case 6:return"int32";case 12:return"uint32";case 10:return"float16";case 1:return"float32";case 11:return"float64";case 8:return"string";case 7:return"int64";case 13:return"uint64";case 22:return"int4";case 21:return"uint4";default:throw new Error(`unsupported data type: ${i}`)}},tr=(i,t)=>{let e=[-1,4,1,1,2,2,4,8,-1,1,2,8,4,8,-1,-1,-1,-1,-1,-1,-1,.5,.5][i],n=typeof t=="number"?t:t.reduce((s,r)=>s*r,1);return e>0?Math.ceil(n*e):void 0},bp=i=>{switch(i){case"float16":return typeof Float16Array<"u"&&Float16Array.from?Float16Array:Uint16Array;case"float32":return Float32Array;case"uint8":return Uint8Array;case"int8":return Int8Array;case"uint16":return Uint16Array;case"int16":return Int16Array;case"int32":return Int32Array;case"bool":return Uint8Array;case"float64":return Float64Array;case"uint32":return Uint32Array;case"int64":return BigInt64Array;case"uint64":return BigUint64Array;default:throw new Error(`unsupported type: ${i}`)}},wp=i=>{switch(i){case"verbose":return 0;case"info":return 1;case"warning":return 2;case"error":return 3;case"fatal":return 4;default:throw new Error(`unsupported logging level: ${i}`)}},tu=i=>i==="float32"||i==="float16"||i==="int32"||i==="int64"||i==="uint32"||i==="uint8"||i==="bool"||i==="uint4"||i==="int4",eu=i=>i==="float32"||i==="float16"||i==="int32"||i==="int64"||i==="uint32"||i==="uint64"||i==="int8"||i==="uint8"||i==="bool"||i==="uint4"||i==="int4",Sp=i=>{switch(i){case"none":return 0;case"cpu":return 1;case"cpu-pinned":return 2;case"texture":return 3;case"gpu-buffer":return 4;case"ml-tensor":return 5;default:throw new Error(`unsupported data location: ${i}`)}}}),nu,Ap=de(()=>{"use strict";Jh(),nu=async i=>{if(typeof i=="string"){let t=await fetch(i);if(!t.ok)throw new Error(`failed to load external data file: ${i}`);let e=t.headers.get("Content-Length"),n=e?parseInt(e,10):0;if(n<1073741824)return new Uint8Array(await t.arrayBuffer());{if(!t.body)throw new Error(`failed to load external data file: ${i}, no response body.`);let s=t.body.getReader(),r;try{r=new ArrayBuffer(n)}catch(o){if(o instanceof RangeError){let l=Math.ceil(n/65536);r=new WebAssembly.Memory({initial:l,maximum:l}).buffer}else throw o}let a=0;for(;;){let{done:o,value:l}=await s.read();if(o)break;let c=l.byteLength;new Uint8Array(r,a,c).set(l),a+=c}return new Uint8Array(r,0,n)}}else return i instanceof Blob?new Uint8Array(await i.arrayBuffer()):i instanceof Uint8Array?i:new Uint8Array(i)}}),Xd,iu,su,ws,$d,kh,Fo,ru,au,zh,ou,lu,cu,Tp=de(()=>{"use strict";Ts(),ty(),ey(),Ep(),rr(),Qh(),Ap(),Xd=(i,t)=>{Le()._OrtInit(i,t)!==0&&Te("Can't initialize onnxruntime.")},iu=async i=>{Xd(i.wasm.numThreads,wp(i.logLevel))},su=async(i,t)=>{Le().asyncInit?.();let e=i.webgpu.adapter;if(t==="webgpu"){if(typeof navigator>"u"||!navigator.gpu)throw new Error("WebGPU is not supported in current environment");if(e){if(typeof e.limits!="object"||typeof e.features!="object"||typeof e.requestDevice!="function")throw new Error("Invalid GPU adapter set in `env.webgpu.adapter`. It must be a GPUAdapter object.")}else{let n=i.webgpu.powerPreference;if(n!==void 0&&n!=="low-power"&&n!=="high-performance")throw new Error(`Invalid powerPreference setting: "${n}"`);let s=i.webgpu.forceFallbackAdapter;if(s!==void 0&&typeof s!="boolean")throw new Error(`Invalid forceFallbackAdapter setting: "${s}"`);if(e=await navigator.gpu.requestAdapter({powerPreference:n,forceFallbackAdapter:s}),!e)throw new Error('Failed to get GPU adapter. You may need to enable flag "--enable-unsafe-webgpu" if you are using Chrome.')}}if(t==="webnn"&&(typeof navigator>"u"||!navigator.ml))throw new Error("WebNN is not supported in current environment")},ws=new Map,$d=i=>{let t=Le(),e=t.stackSave();try{let n=t.PTR_SIZE,s=t.stackAlloc(2*n);t._OrtGetInputOutputCount(i,s,s+n)!==0&&Te("Can't get session input/output count.");let r=n===4?"i32":"i64";return[Number(t.getValue(s,r)),Number(t.getValue(s+n,r))]}finally{t.stackRestore(e)}},kh=(i,t)=>{let e=Le(),n=e.stackSave(),s=0;try{let r=e.PTR_SIZE,a=e.stackAlloc(2*r);e._OrtGetInputOutputMetadata(i,t,a,a+r)!==0&&Te("Can't get session input/output metadata.");let o=Number(e.getValue(a,"*"));s=Number(e.getValue(a+r,"*"));let l=e.HEAP32[s/4];if(l===0)return[o,0];let c=e.HEAPU32[s/4+1],h=[];for(let u=0;u<c;u++){let f=Number(e.getValue(s+8+u*r,"*"));h.push(f!==0?e.UTF8ToString(f):Number(e.getValue(s+8+(u+c)*r,"*")))}return[o,l,h]}finally{e.stackRestore(n),s!==0&&e._OrtFree(s)}},Fo=i=>{let t=Le(),e=t._malloc(i.byteLength);if(e===0)throw new Error(`Can't create a session. failed to allocate a buffer of size ${i.byteLength}.`);return t.HEAPU8.set(i,e),[e,i.byteLength]},ru=async(i,t)=>{let e,n,s=Le();Array.isArray(i)?[e,n]=i:i.buffer===s.HEAPU8.buffer?[e,n]=[i.byteOffset,i.byteLength]:[e,n]=Fo(i);let r=0,a=0,o=0,l=[],c=[],h=[];try{if([a,l]=await Mp(t),t?.externalData&&s.mountExternalData){let w=[];for(let b of t.externalData){let E=typeof b=="string"?b:b.path;w.push(nu(typeof b=="string"?b:b.data).then(T=>{s.mountExternalData(E,T)}))}await Promise.all(w)}for(let w of t?.executionProviders??[])if((typeof w=="string"?w:w.name)==="webnn"){if(s.shouldTransferToMLTensor=!1,typeof w!="string"){let b=w,E=b?.context,T=b?.gpuDevice,x=b?.deviceType,A=b?.powerPreference;E?s.currentContext=E:T?s.currentContext=await s.webnnCreateMLContext(T):s.currentContext=await s.webnnCreateMLContext({deviceType:x,powerPreference:A})}else s.currentContext=await s.webnnCreateMLContext();break}r=await s._OrtCreateSession(e,n,a),s.webgpuOnCreateSession?.(r),r===0&&Te("Can't create a session."),s.jsepOnCreateSession?.(),s.currentContext&&(s.webnnRegisterMLContext(r,s.currentContext),s.currentContext=void 0,s.shouldTransferToMLTensor=!0);let[u,f]=$d(r),d=!!t?.enableGraphCapture,m=[],_=[],p=[],g=[],y=[];for(let w=0;w<u;w++){let[b,E,T]=kh(r,w);b===0&&Te("Can't get an input name."),c.push(b);let x=s.UTF8ToString(b);m.push(x),p.push(E===0?{name:x,isTensor:!1}:{name:x,isTensor:!0,type:Do(E),shape:T})}for(let w=0;w<f;w++){let[b,E,T]=kh(r,w+u);b===0&&Te("Can't get an output name."),h.push(b);let x=s.UTF8ToString(b);_.push(x),g.push(E===0?{name:x,isTensor:!1}:{name:x,isTensor:!0,type:Do(E),shape:T})}return ws.set(r,[r,c,h,null,d,!1]),[r,m,_,p,g]}catch(u){throw c.forEach(f=>s._OrtFree(f)),h.forEach(f=>s._OrtFree(f)),o!==0&&s._OrtReleaseBinding(o)!==0&&Te("Can't release IO binding."),r!==0&&s._OrtReleaseSession(r)!==0&&Te("Can't release session."),u}finally{s._free(e),a!==0&&s._OrtReleaseSessionOptions(a)!==0&&Te("Can't release session options."),l.forEach(u=>s._free(u)),s.unmountExternalData?.()}},au=i=>{let t=Le(),e=ws.get(i);if(!e)throw new Error(`cannot release session. invalid session id: ${i}`);let[n,s,r,a,o]=e;a&&(o&&t._OrtClearBoundOutputs(a.handle)!==0&&Te("Can't clear bound outputs."),t._OrtReleaseBinding(a.handle)!==0&&Te("Can't release IO binding.")),t.jsepOnReleaseSession?.(i),t.webnnOnReleaseSession?.(i),t.webgpuOnReleaseSession?.(i),s.forEach(l=>t._OrtFree(l)),r.forEach(l=>t._OrtFree(l)),t._OrtReleaseSession(n)!==0&&Te("Can't release session."),ws.delete(i)},zh=async(i,t,e,n,s,r,a=!1)=>{if(!i){t.push(0);return}let o=Le(),l=o.PTR_SIZE,c=i[0],h=i[1],u=i[3],f=u,d,m;if(c==="string"&&(u==="gpu-buffer"||u==="ml-tensor"))throw new Error("String tensor is not supported on GPU.");if(a&&u!=="gpu-buffer")throw new Error(`External buffer must be provided for input/output index ${r} when enableGraphCapture is true.`);if(u==="gpu-buffer"){let g=i[2].gpuBuffer;m=tr(Qs(c),h);{let y=o.jsepRegisterBuffer;if(!y)throw new Error('Tensor location "gpu-buffer" is not supported without using WebGPU.');d=y(n,r,g,m)}}else if(u==="ml-tensor"){let g=i[2].mlTensor;m=tr(Qs(c),h);let y=o.webnnRegisterMLTensor;if(!y)throw new Error('Tensor location "ml-tensor" is not supported without using WebNN.');d=y(n,g,Qs(c),h)}else{let g=i[2];if(Array.isArray(g)){m=l*g.length,d=o._malloc(m),e.push(d);for(let y=0;y<g.length;y++){if(typeof g[y]!="string")throw new TypeError(`tensor data at index ${y} is not a string`);o.setValue(d+y*l,oi(g[y],e),"*")}}else{let y=o.webnnIsGraphInput,w=o.webnnIsGraphOutput;if(c!=="string"&&y&&w){let b=o.UTF8ToString(s);if(y(n,b)||w(n,b)){let E=Qs(c);m=tr(E,h),f="ml-tensor";let T=o.webnnCreateTemporaryTensor,x=o.webnnUploadTensor;if(!T||!x)throw new Error('Tensor location "ml-tensor" is not supported without using WebNN.');let A=await T(n,E,h);x(A,new Uint8Array(g.buffer,g.byteOffset,g.byteLength)),d=A}else m=g.byteLength,d=o._malloc(m),e.push(d),o.HEAPU8.set(new Uint8Array(g.buffer,g.byteOffset,m),d)}else m=g.byteLength,d=o._malloc(m),e.push(d),o.HEAPU8.set(new Uint8Array(g.buffer,g.byteOffset,m),d)}}let _=o.stackSave(),p=o.stackAlloc(4*h.length);try{h.forEach((y,w)=>o.setValue(p+w*l,y,l===4?"i32":"i64"));let g=o._OrtCreateTensor(Qs(c),d,m,p,h.length,Sp(f));g===0&&Te(`Can't create tensor for input/output. session=${n}, index=${r}.`),t.push(g)}finally{o.stackRestore(_)}},ou=async(i,t,e,n,s,r)=>{let a=Le(),o=a.PTR_SIZE,l=ws.get(i);if(!l)throw new Error(`cannot run inference. invalid session id: ${i}`);let c=l[0],h=l[1],u=l[2],f=l[3],d=l[4],m=l[5],_=t.length,p=n.length,g=0,y=[],w=[],b=[],E=[],T=a.stackSave(),x=a.stackAlloc(_*o),A=a.stackAlloc(_*o),F=a.stackAlloc(p*o),L=a.stackAlloc(p*o);try{[g,y]=vp(r),ir("wasm prepareInputOutputTensor");for(let P=0;P<_;P++)await zh(e[P],w,E,i,h[t[P]],t[P],d);for(let P=0;P<p;P++)await zh(s[P],b,E,i,u[n[P]],_+n[P],d);sr("wasm prepareInputOutputTensor");for(let P=0;P<_;P++)a.setValue(x+P*o,w[P],"*"),a.setValue(A+P*o,h[t[P]],"*");for(let P=0;P<p;P++)a.setValue(F+P*o,b[P],"*"),a.setValue(L+P*o,u[n[P]],"*");a.jsepOnRunStart?.(c),a.webnnOnRunStart?.(c);let O;O=await a._OrtRun(c,A,x,_,L,p,F,g),O!==0&&Te("failed to call OrtRun().");let H=[],Z=[];ir("wasm ProcessOutputTensor");for(let P=0;P<p;P++){let W=Number(a.getValue(F+P*o,"*"));if(W===b[P]){H.push(s[P]);continue}let tt=a.stackSave(),$=a.stackAlloc(4*o),at=!1,X,k=0;try{a._OrtGetTensorData(W,$,$+o,$+2*o,$+3*o)!==0&&Te(`Can't access output tensor data on index ${P}.`);let it=o===4?"i32":"i64",Tt=Number(a.getValue($,it));k=a.getValue($+o,"*");let kt=a.getValue($+o*2,"*"),et=Number(a.getValue($+o*3,it)),pt=[];for(let lt=0;lt<et;lt++)pt.push(Number(a.getValue(kt+lt*o,it)));a._OrtFree(kt)!==0&&Te("Can't free memory for tensor dims.");let _t=pt.reduce((lt,At)=>lt*At,1);X=Do(Tt);let Nt=f?.outputPreferredLocations[n[P]];if(X==="string"){if(Nt==="gpu-buffer"||Nt==="ml-tensor")throw new Error("String tensor is not supported on GPU.");let lt=[];for(let At=0;At<_t;At++){let ae=a.getValue(k+At*o,"*"),Ft=a.getValue(k+(At+1)*o,"*"),ee=At===_t-1?void 0:Ft-ae;lt.push(a.UTF8ToString(ae,ee))}H.push([X,pt,lt,"cpu"])}else if(Nt==="gpu-buffer"&&_t>0){let lt=a.jsepGetBuffer;if(!lt)throw new Error('preferredLocation "gpu-buffer" is not supported without using WebGPU.');let At=lt(k),ae=tr(Tt,_t);if(ae===void 0||!tu(X))throw new Error(`Unsupported data type: ${X}`);at=!0,H.push([X,pt,{gpuBuffer:At,download:a.jsepCreateDownloader(At,ae,X),dispose:()=>{a._OrtReleaseTensor(W)!==0&&Te("Can't release tensor.")}},"gpu-buffer"])}else if(Nt==="ml-tensor"&&_t>0){let lt=a.webnnEnsureTensor,At=a.webnnIsGraphInputOutputTypeSupported;if(!lt||!At)throw new Error('preferredLocation "ml-tensor" is not supported without using WebNN.');if(tr(Tt,_t)===void 0||!eu(X))throw new Error(`Unsupported data type: ${X}`);if(!At(i,X,!1))throw new Error(`preferredLocation "ml-tensor" for ${X} output is not supported by current WebNN Context.`);let ae=await lt(i,k,Tt,pt,!1);at=!0,H.push([X,pt,{mlTensor:ae,download:a.webnnCreateMLTensorDownloader(k,X),dispose:()=>{a.webnnReleaseTensorId(k),a._OrtReleaseTensor(W)}},"ml-tensor"])}else if(Nt==="ml-tensor-cpu-output"&&_t>0){let lt=a.webnnCreateMLTensorDownloader(k,X)(),At=H.length;at=!0,Z.push((async()=>{let ae=[At,await lt];return a.webnnReleaseTensorId(k),a._OrtReleaseTensor(W),ae})()),H.push([X,pt,[],"cpu"])}else{let lt=bp(X),At=new lt(_t);new Uint8Array(At.buffer,At.byteOffset,At.byteLength).set(a.HEAPU8.subarray(k,k+At.byteLength)),H.push([X,pt,At,"cpu"])}}finally{a.stackRestore(tt),X==="string"&&k&&a._free(k),at||a._OrtReleaseTensor(W)}}f&&!d&&(a._OrtClearBoundOutputs(f.handle)!==0&&Te("Can't clear bound outputs."),ws.set(i,[c,h,u,f,d,!1]));for(let[P,W]of await Promise.all(Z))H[P][2]=W;return sr("wasm ProcessOutputTensor"),H}finally{a.webnnOnRunEnd?.(c),a.stackRestore(T),w.forEach(O=>a._OrtReleaseTensor(O)),b.forEach(O=>a._OrtReleaseTensor(O)),E.forEach(O=>a._free(O)),g!==0&&a._OrtReleaseRunOptions(g),y.forEach(O=>a._free(O))}},lu=i=>{let t=Le(),e=ws.get(i);if(!e)throw new Error("invalid session id");let n=e[0],s=t._OrtEndProfiling(n);s===0&&Te("Can't get an profile file name."),t._OrtFree(s)},cu=i=>{let t=[];for(let e of i){let n=e[2];!Array.isArray(n)&&"buffer"in n&&t.push(n.buffer)}return t}}),ji,Zn,js,la,ca,Lo,Gh,No,Ss,Es,qd,Rp,Cp,Pp,Ip,Lp,Np,Dp,Op=de(()=>{"use strict";Ts(),Tp(),rr(),Kh(),ji=()=>!!Re.wasm.proxy&&typeof document<"u",js=!1,la=!1,ca=!1,No=new Map,Ss=(i,t)=>{let e=No.get(i);e?e.push(t):No.set(i,[t])},Es=()=>{if(js||!la||ca||!Zn)throw new Error("worker not ready")},qd=i=>{switch(i.data.type){case"init-wasm":js=!1,i.data.err?(ca=!0,Gh[1](i.data.err)):(la=!0,Gh[0]()),Lo&&(URL.revokeObjectURL(Lo),Lo=void 0);break;case"init-ep":case"copy-from":case"create":case"release":case"run":case"end-profiling":{let t=No.get(i.data.type);i.data.err?t.shift()[1](i.data.err):t.shift()[0](i.data.out);break}default:}},Rp=async()=>{if(!la){if(js)throw new Error("multiple calls to 'initWasm()' detected.");if(ca)throw new Error("previous call to 'initWasm()' failed.");if(js=!0,ji())return new Promise((i,t)=>{Zn?.terminate(),yp().then(([e,n])=>{try{Zn=n,Zn.onerror=r=>t(r),Zn.onmessage=qd,Gh=[i,t];let s={type:"init-wasm",in:Re};!s.in.wasm.wasmPaths&&(e||Xh)&&(s.in.wasm.wasmPaths={wasm:new URL("ort-wasm-simd-threaded.wasm",studioAddress).href}),Zn.postMessage(s),Lo=e}catch(s){t(s)}},t)});try{await jh(Re.wasm),await iu(Re),la=!0}catch(i){throw ca=!0,i}finally{js=!1}}},Cp=async i=>{if(ji())return Es(),new Promise((t,e)=>{Ss("init-ep",[t,e]);let n={type:"init-ep",in:{epName:i,env:Re}};Zn.postMessage(n)});await su(Re,i)},Pp=async i=>ji()?(Es(),new Promise((t,e)=>{Ss("copy-from",[t,e]);let n={type:"copy-from",in:{buffer:i}};Zn.postMessage(n,[i.buffer])})):Fo(i),Ip=async(i,t)=>{if(ji()){if(t?.preferredOutputLocation)throw new Error('session option "preferredOutputLocation" is not supported for proxy.');return Es(),new Promise((e,n)=>{Ss("create",[e,n]);let s={type:"create",in:{model:i,options:{...t}}},r=[];i instanceof Uint8Array&&r.push(i.buffer),Zn.postMessage(s,r)})}else return ru(i,t)},Lp=async i=>{if(ji())return Es(),new Promise((t,e)=>{Ss("release",[t,e]);let n={type:"release",in:i};Zn.postMessage(n)});au(i)},Np=async(i,t,e,n,s,r)=>{if(ji()){if(e.some(a=>a[3]!=="cpu"))throw new Error("input tensor on GPU is not supported for proxy.");if(s.some(a=>a))throw new Error("pre-allocated output tensor is not supported for proxy.");return Es(),new Promise((a,o)=>{Ss("run",[a,o]);let l=e,c={type:"run",in:{sessionId:i,inputIndices:t,inputs:l,outputIndices:n,options:r}};Zn.postMessage(c,cu(l))})}else return ou(i,t,e,n,s,r)},Dp=async i=>{if(ji())return Es(),new Promise((t,e)=>{Ss("end-profiling",[t,e]);let n={type:"end-profiling",in:i};Zn.postMessage(n)});lu(i)}}),Vh,Yd,Up,ny=de(()=>{"use strict";Ts(),Op(),Ep(),Jh(),Ap(),Vh=(i,t)=>{switch(i.location){case"cpu":return[i.type,i.dims,i.data,"cpu"];case"gpu-buffer":return[i.type,i.dims,{gpuBuffer:i.gpuBuffer},"gpu-buffer"];case"ml-tensor":return[i.type,i.dims,{mlTensor:i.mlTensor},"ml-tensor"];default:throw new Error(`invalid data location: ${i.location} for ${t()}`)}},Yd=i=>{switch(i[3]){case"cpu":return new on(i[0],i[2],i[1]);case"gpu-buffer":{let t=i[0];if(!tu(t))throw new Error(`not supported data type: ${t} for deserializing GPU tensor`);let{gpuBuffer:e,download:n,dispose:s}=i[2];return on.fromGpuBuffer(e,{dataType:t,dims:i[1],download:n,dispose:s})}case"ml-tensor":{let t=i[0];if(!eu(t))throw new Error(`not supported data type: ${t} for deserializing MLTensor tensor`);let{mlTensor:e,download:n,dispose:s}=i[2];return on.fromMLTensor(e,{dataType:t,dims:i[1],download:n,dispose:s})}default:throw new Error(`invalid data location: ${i[3]}`)}},Up=class{async fetchModelAndCopyToWasmMemory(i){return Pp(await nu(i))}async loadModel(i,t){er();let e;typeof i=="string"?e=await this.fetchModelAndCopyToWasmMemory(i):e=i,[this.sessionId,this.inputNames,this.outputNames,this.inputMetadata,this.outputMetadata]=await Ip(e,t),nr()}async dispose(){return Lp(this.sessionId)}async run(i,t,e){er();let n=[],s=[];Object.entries(i).forEach(u=>{let f=u[0],d=u[1],m=this.inputNames.indexOf(f);if(m===-1)throw new Error(`invalid input '${f}'`);n.push(d),s.push(m)});let r=[],a=[];Object.entries(t).forEach(u=>{let f=u[0],d=u[1],m=this.outputNames.indexOf(f);if(m===-1)throw new Error(`invalid output '${f}'`);r.push(d),a.push(m)});let o=n.map((u,f)=>Vh(u,()=>`input "${this.inputNames[s[f]]}"`)),l=r.map((u,f)=>u?Vh(u,()=>`output "${this.outputNames[a[f]]}"`):null),c=await Np(this.sessionId,s,o,a,l,e),h={};for(let u=0;u<c.length;u++)h[this.outputNames[a[u]]]=r[u]??Yd(c[u]);return nr(),h}startProfiling(){}endProfiling(){Dp(this.sessionId)}}}),Fp={};Bo(Fp,{OnnxruntimeWebAssemblyBackend:()=>qh,initializeFlags:()=>$h,wasmBackend:()=>Bp});var $h,qh,Bp,iy=de(()=>{"use strict";Ts(),Op(),ny(),$h=()=>{(typeof Re.wasm.initTimeout!="number"||Re.wasm.initTimeout<0)&&(Re.wasm.initTimeout=0);let i=Re.wasm.simd;if(typeof i!="boolean"&&i!==void 0&&i!=="fixed"&&i!=="relaxed"&&(console.warn(`Property "env.wasm.simd" is set to unknown value "${i}". Reset it to \`false\` and ignore SIMD feature checking.`),Re.wasm.simd=!1),typeof Re.wasm.proxy!="boolean"&&(Re.wasm.proxy=!1),typeof Re.wasm.trace!="boolean"&&(Re.wasm.trace=!1),typeof Re.wasm.numThreads!="number"||!Number.isInteger(Re.wasm.numThreads)||Re.wasm.numThreads<=0)if(typeof self<"u"&&!self.crossOriginIsolated)Re.wasm.numThreads=1;else{let t=typeof navigator>"u"?U_("node:os").cpus().length:navigator.hardwareConcurrency;Re.wasm.numThreads=Math.min(4,Math.ceil((t||1)/2))}},qh=class{async init(i){$h(),await Rp(),await Cp(i)}async createInferenceSessionHandler(i,t){let e=new Up;return await e.loadModel(i,t),e}},Bp=new qh});Ts();Ts();Ts();var sy="1.23.2";{let i=(iy(),Hh(Fp)).wasmBackend;Oo("cpu",i,10),Oo("wasm",i,10)}Object.defineProperty(Re.versions,"web",{value:sy,enumerable:!0});var Rs=class{constructor(t){let e=new DataView(t.buffer,t.byteOffset,t.byteLength),n=Number(e.getBigUint64(0,!0));this.entries=JSON.parse(new TextDecoder().decode(t.subarray(8,8+n))),this.data=t.subarray(8+n)}has(t){return t in this.entries}shape(t){return this.entries[t].shape}raw(t,e){let[n,s]=this.entries[t].data_offsets;return new e(this.data.slice(n,s).buffer)}scales(t){return this.floats(`${t}.int8_scale`)}adapter(t){let e=Object.keys(this.entries).filter(l=>kp.test(l)).sort(),n=(l,c,h)=>l.replace(kp,`.adapters.${c}.${h}.weight`),s=0;for(let l=0;this.has(n(e[0],l,0));l++)s=Math.max(s,this.shape(n(e[0],l,0))[0]);let r=e.map(l=>[this.shape(l)[1],this.shape(n(l,0,1))[0]]),a=new Float32Array(s*r.flat().reduce((l,c)=>l+c,0)),o=0;return e.forEach((l,c)=>{let[h,u]=r[c],f=n(l,t,0),d=n(l,t,1),m=this.shape(f)[0];a.set(this.floats(f),o),o+=s*h;let _=this.floats(d);for(let p=0;p<u;p++,o+=s)a.set(_.subarray(p*m,(p+1)*m),o)}),a}floats(t){let{dtype:e}=this.entries[t];if(e==="F32")return this.raw(t,Float32Array);if(e==="F16")return Float32Array.from(this.raw(t,Uint16Array),oy);if(e!=="I8")throw new Error(`${t} is stored as ${e}`);let n=this.scales(t),s=Float32Array.from(this.raw(t,Int8Array)),r=s.length/n.length;for(let a=0,o=0;a<n.length;a++)for(let l=o+r;o<l;o++)s[o]*=n[a];return s}ready(t){let e=t.replace(ay,""),n=this.floats(e);if(e===t)return n;let[s,r]=this.shape(e),a=new Float32Array(n.length);for(let o=0,l=0;o<s;o++)for(let c=0;c<r;c++)a[c*s+o]=n[l++];return a}},ay=/\/turned$/,kp=/\.adapters\.0\.0\.weight$/;function oy(i){let t=i>>15?-1:1,e=i>>10&31,n=i&1023;return e===0?t*n*2**-24:t*(1+n/1024)*2**(e-15)}var ar=class{constructor(t,e){Re.wasm.numThreads=1,Re.wasm.wasmBinary=t.wasm.buffer,Re.logLevel="error",Object.assign(this,{parts:t,names:e,weights:new Rs(t.weights)}),this.sessions={},this.adapters={},this.helper=null}session(t){return this.sessions[t]??=ko.create(this.parts[t],{externalData:this.names[t].map(e=>({path:e,data:new Uint8Array(this.weights.ready(e).buffer)})),graphOptimizationLevel:"disabled"}).catch(e=>{throw delete this.sessions[t],e}),this.sessions[t]}adapter(t,e){let n=`${t} ${e}`;if(!this.adapters[n]){let s=this.weights.adapter(t-1);this.adapters[n]=new on("float32",zo(Array(e).fill(s)),[e,s.length])}return this.adapters[n]}async predict(t,e,n,s,r,a=0){if(this.helper&&t.length>1){let d=t.length>>1,m=[t.slice(d),e,n.slice(d),s,r,a],_=this.helper(...m).catch(()=>null),p=await this.predict(t.slice(0,d),e,n.slice(0,d),s,r,a),g=await _;return g===null&&(this.helper=null,g=await this.predict(...m)),[...p,...g]}let o=t.length,l=t[0].length,c=l/138,h=[o,c,23,6],u=a&&{adapter:this.adapter(a,o)},{prediction:f}=await(await this.session(a?"adapted":"graph")).run({x:new on("float32",zo(t),h),t:new on("int64",new BigInt64Array(o).fill(BigInt(e)),[o]),pooled:new on("float32",zo(n),[o,n[0].length]),tag:new on("int64",new BigInt64Array(o).fill(BigInt(s)),[o]),mask:new on("bool",new Uint8Array(o*c).fill(1),[o,c]),known:new on("bool",zo(t.map(()=>r),Uint8Array),h),...u});return t.map((d,m)=>f.data.slice(m*l,(m+1)*l))}};function zo(i,t=Float32Array){let e=new t(i.length*i[0].length);return i.forEach((n,s)=>e.set(n,s*n.length)),e}var li=(i,t)=>i[0]*t[0]+i[1]*t[1]+i[2]*t[2],jt=i=>Math.hypot(i[0],i[1],i[2]),Pe=(i,t)=>[i[0]+t[0],i[1]+t[1],i[2]+t[2]],Ne=(i,t)=>[i[0]-t[0],i[1]-t[1],i[2]-t[2]],De=(i,t)=>[i[0]*t,i[1]*t,i[2]*t],Pi=(i,t)=>[i[1]*t[2]-i[2]*t[1],i[2]*t[0]-i[0]*t[2],i[0]*t[1]-i[1]*t[0]],Ze=(i,t=1e-12)=>De(i,1/Math.max(jt(i),t)),Jn=(i,t,e)=>Math.min(Math.max(i,t),e),we=(i,t)=>{let e=new Array(9);for(let n=0;n<9;n+=3)for(let s=0;s<3;s++)e[n+s]=i[n]*t[s]+i[n+1]*t[3+s]+i[n+2]*t[6+s];return e},xi=i=>[i[0],i[3],i[6],i[1],i[4],i[7],i[2],i[5],i[8]],Je=(i,t)=>[i[0]*t[0]+i[1]*t[1]+i[2]*t[2],i[3]*t[0]+i[4]*t[1]+i[5]*t[2],i[6]*t[0]+i[7]*t[1]+i[8]*t[2]];function Cs(i,t=0){let e=[i[t],i[t+1],i[t+2]],n=[i[t+3],i[t+4],i[t+5]];jt(e)>1e-6||(e=[1,0,0]);let s=Ze(e,1e-6),r=Ne(n,De(s,li(s,n)));if(jt(r)<=1e-6*(1+jt(n))){let o=s.map(Math.abs),l=[0,0,0];l[o.indexOf(Math.min(...o))]=1,r=Ne(l,De(s,li(s,l)))}r=Ze(r,1e-6);let a=Pi(s,r);return[s[0],r[0],a[0],s[1],r[1],a[1],s[2],r[2],a[2]]}function fa(i,t,e){t.set([i[0],i[3],i[6],i[1],i[4],i[7]],e)}function wn(i){let t=[1+i[0]+i[4]+i[8],1+i[0]-i[4]-i[8],1-i[0]+i[4]-i[8],1-i[0]-i[4]+i[8]],[e,n,s]=[i[7]-i[5],i[2]-i[6],i[3]-i[1]],[r,a,o]=[i[3]+i[1],i[2]+i[6],i[7]+i[5]],c=[[t[0],e,n,s],[e,t[1],r,a],[n,r,t[2],o],[s,a,o,t[3]]][t.indexOf(Math.max(...t))],h=Math.hypot(...c)*(c[0]<0?-1:1);return c.map(u=>u/h)}function Ke(i,t=0){let e=Math.max(Math.hypot(i[t],i[t+1],i[t+2],i[t+3]),1e-12),[n,s,r,a]=[i[t]/e,i[t+1]/e,i[t+2]/e,i[t+3]/e];return[1-2*(r*r+a*a),2*(s*r-n*a),2*(s*a+n*r),2*(s*r+n*a),1-2*(s*s+a*a),2*(r*a-n*s),2*(s*a-n*r),2*(r*a+n*s),1-2*(s*s+r*r)]}var ua=(i,t)=>[i[0]*t[0]-i[1]*t[1]-i[2]*t[2]-i[3]*t[3],i[0]*t[1]+i[1]*t[0]+i[2]*t[3]-i[3]*t[2],i[0]*t[2]-i[1]*t[3]+i[2]*t[0]+i[3]*t[1],i[0]*t[3]+i[1]*t[2]-i[2]*t[1]+i[3]*t[0]],hu=i=>[i[0],-i[1],-i[2],-i[3]];function Go(i){let t=i[0]<0?-1:1,e=Math.hypot(i[1],i[2],i[3]),n=e>1e-6?2*Math.atan2(e,t*i[0])/e:2;return[t*i[1]*n,t*i[2]*n,t*i[3]*n]}function or(i){let t=jt(i),e=t>1e-6?Math.sin(t/2)/t:.5;return[Math.cos(t/2),i[0]*e,i[1]*e,i[2]*e]}var Ii=(i,t,e)=>ua(i,or(De(Go(ua(hu(i),t)),e)));function Gn(i,t){for(let e=0;e<t;e+=4)for(let n=e;n<i.length;n+=t){let s=n-t;if((s<0?i[n]:i[n]*i[s]+i[n+1]*i[s+1]+i[n+2]*i[s+2]+i[n+3]*i[s+3])<0)for(let a=0;a<4;a++)i[n+a]=-i[n+a]}return i}function da(i){let[t,e]=[Math.cos(i),Math.sin(i)];return[t,0,e,0,1,0,-e,0,t]}function uu([i,t,e],n){let[s,r]=[Math.cos(n),Math.sin(n)];return[s*i+r*e,t,s*e-r*i]}var pa=(i,t)=>Ke(or(De(i,t)));function zp(i,t){let[e,n]=[Ze(i),Ze(t)],s=Pi(e,n);return pa(Ze(s),Math.atan2(jt(s),li(e,n)))}function Vo(i){let t=wn(i);return 2*Math.atan2(t[2],t[0])}function Ps(i){let t=0;for(let e=1,n=i[0];e<i.length;e++){let s=i[e]-n;n=i[e];let r=((s+Math.PI)%(2*Math.PI)+2*Math.PI)%(2*Math.PI)-Math.PI;r===-Math.PI&&s>0&&(r=Math.PI),Math.abs(s)>=Math.PI&&(t+=r-s),i[e]+=t}return i}var qt=22,Et=30,Ee={names:[],parents:[],offsets:[]},Se={},Kn,Is,lr,ma,ci,ga;function Ho({names:i,parents:t,offsets:e,tips:n,limbs:s,groups:r}){Object.assign(Ee,{names:i,parents:t,offsets:e,tips:n}),i.forEach((a,o)=>{Se[a]=o}),ci=["left-leg","right-leg"].map(a=>s[a].map(o=>Se[o])),ma=ci.map(([,,a,o])=>({ankle:a,ball:o})),ga=r,Kn=.02,Is=Kn-ci[0].reduce((a,o)=>a+e[o][1],0),lr=-e[ci[0][1]][1]-e[ci[0][2]][1]}function ly(i,t){let{parents:e,offsets:n}=Ee,s=[i[0]],r=[t];for(let a=1;a<qt;a++){let o=e[a];s.push(we(s[o],i[a])),r.push(Pe(r[o],Je(s[o],n[a])))}return{positions:r,world:s}}function Ln(i,t){let e=[];for(let n=0;n<qt;n++)e.push(Ke(i.quaternions,(t*qt+n)*4));return ly(e,Array.from(i.root.subarray(t*3,t*3+3)))}var cy=23,It=cy*6,ue=132,[Sn,Nn,_a,Xe,cr]=[0,1,2,3,4],hr={x:0,z:0,heading:0},Me=i=>i.length/It,je=(i,t,e)=>i.slice(t*It,e*It);function fu(i,t,e=0,n=Me(i)){for(let s of t){let r=0;for(let a=e;a<n;a++)r+=i[a*It+ue+s];for(let a=e;a<n;a++)i[a*It+ue+s]-=r/(n-e)}}function jn(i,t=Float32Array){let e=new t(i.reduce((s,r)=>s+r.length,0)),n=0;for(let s of i)e.set(s,n),n+=s.length;return e}function Wo(i,t=hr,e=Et,n=(r,a)=>i[r*It+ue+a],s=Me(i)){let r=new Float64Array(s*3),a=new Float64Array(s),{x:o,z:l,heading:c}=t;for(let h=0;h<s;h++){r.set([o,n(h,_a),l],h*3),a[h]=c;let[u,f]=[Math.sin(c),Math.cos(c)],[d,m]=[n(h,Sn),n(h,Nn)];o+=(d*u+m*f)/e,l+=(d*f-m*u)/e,c+=n(h,Xe)/e}return{path:r,heading:a,end:{x:o,z:l,heading:c}}}function Qi(i,t=hr,e="",n=Et){let s=Me(i),{path:r,heading:a}=Wo(i,t,n),o=new Float32Array(s*qt*4),l=new Float32Array(s*2);for(let c=0;c<s;c++){for(let h=0;h<qt;h++){let u=Cs(i,c*It+h*6);h===0&&(u=we(da(a[c]),u)),o.set(wn(u),(c*qt+h)*4)}for(let h of[0,1])l[c*2+h]=Jn(i[c*It+ue+cr+h],0,1)}return Gn(o,qt*4),{frames:s,quaternions:o,root:Float32Array.from(r),contacts:l,fps:n,text:e}}function ur(i){let t=new Float64Array(i.frames);for(let e=0;e<i.frames;e++)t[e]=Vo(Ke(i.quaternions,e*qt*4));return Ps(t)}function fr(i,t){return{x:i.root[t*3],z:i.root[t*3+2],heading:ur(i)[t]}}function du(i){let{frames:t,fps:e}=i,n=new Float32Array(t*It),s=ur(i);for(let r=0;r<t;r++){let a=da(-s[r]);for(let d=0;d<qt;d++){let m=Ke(i.quaternions,(r*qt+d)*4);fa(d===0?we(a,m):m,n,r*It+d*6)}let o=r*It+ue,l=Math.max(Math.min(r,t-2),0),c=t<2?[0,0,0]:[0,1,2].map(d=>(i.root[(l+1)*3+d]-i.root[l*3+d])*e),[h,,u]=Je(a,c),f=t<2?0:(s[l+1]-s[l])*e;n.set([u,h,i.root[r*3+1],f,i.contacts[r*2],i.contacts[r*2+1]],o)}return n}function En(i,t,e="nearest"){let n=Math.floor(4*t+.5),s=[];for(let a=-n;a<=n;a++)s.push(Math.exp(-.5*a*a/(t*t)));let r=s.reduce((a,o)=>a+o,0);return i.map((a,o)=>{let l=0;for(let c=-n;c<=n;c++)l+=s[c+n]*i[Gp(o+c,i.length,e)];return l/r})}function Gp(i,t,e){if(e==="nearest")return Math.min(Math.max(i,0),t-1);let n=2*t,s=(i%n+n)%n;return s<t?s:n-1-s}function Vp(i,t,e){let n=Math.floor(t/2);return i.map((s,r)=>{let a=i[r];for(let o=-n;o<=t-1-n;o++)a=e(a,i[Gp(r+o,i.length,"reflect")]);return a})}var pu=(i,t)=>Vp(i,t,Math.max),Hp=(i,t)=>Vp(i,t,Math.min),Vn=i=>i.map((t,e)=>e===0?i[1]-i[0]:e===i.length-1?i[e]-i[e-1]:(i[e+1]-i[e-1])/2);function An(i,t){let e=[...i].sort((a,o)=>a-o),n=(e.length-1)*t/100,s=Math.floor(n),r=e[Math.min(s+1,e.length-1)];return e[s]+(n-s)*(r-e[s])}function Xo(i,t,e){if(i<=t[0])return e[0];if(i>=t[t.length-1])return e[e.length-1];let n=0,s=t.length-1;for(;s-n>1;){let r=n+s>>1;t[r]<=i?n=r:s=r}return e[n]+(e[s]-e[n])*(i-t[n])/(t[s]-t[n])}var mu=(i,t,e)=>Array.from({length:e},(n,s)=>e===1?i:i+(t-i)*s/(e-1));function Yt(i){let t=Math.floor(i);return i-t!==.5?Math.round(i):t%2===0?t:t+1}var hy=3,uy=.15;function Jo(i){let e=.92*(Is+["spine1","spine2","spine3","neck","head"].reduce((n,s)=>n+Ee.offsets[Se[s]][1],0));for(let n=Math.max(0,i.frames-hy);n<i.frames;n++){let{positions:s}=Ln(i,n);if(!(s[Se.head][1]>e)||["l_wrist","r_wrist"].some(r=>s[Se[r]][1]-s[0][1]>=uy))return!1}return!0}function ya(i,t){let e=Math.max(Math.floor(Math.min(t,i.length)/2)*2+1,1),n=e>>1,s=i.length-1;return i.map((r,a)=>{let o=0;for(let l=-n;l<=n;l++)o+=i[Math.min(Math.max(a+l,0),s)];return o/e})}function Li(i,t,e){let n=0,s=i[0]<=t;for(let r of i)s&&r>t?(n++,s=!1):r<e&&(s=!0);return n}var qo=(i,t)=>i.map(e=>e[t]),gu=(i,t)=>{let e=[0,1,2].map(n=>ya(qo(i,n),t));return i.map((n,s)=>[e[0][s],e[1][s],e[2][s]])},Qn=(i,t)=>i.map((e,n)=>[e[0]-t[n][0],e[1]-t[n][1],e[2]-t[n][2]]),$o=i=>i.map(t=>Math.hypot(...t)),Ls=i=>i.reduce((t,e)=>t+e,0),fy=i=>[Math.min(...i),Math.max(...i)];function Ko(i){let{fps:t,frames:e}=i,n=Array.from({length:e},(f,d)=>Ln(i,d)),s=ya(Array.from(ur(i)),Yt(.5*t)),r={},a=f=>r[f]??=gu(n.map(({positions:d})=>d[Se[f]]),Yt(.1*t)),o=f=>Qn(a(f),a("pelvis")).map(([d,m,_],p)=>{let[g,y]=[Math.sin(s[p]),Math.cos(s[p])];return[d*y-_*g,m,d*g+_*y]}),l=n.map(({world:f})=>[f[Se.spine3][1],f[Se.spine3][4],f[Se.spine3][7]]),c={fps:t,frames:e,heading:s,joint:a,seen:o,up:l,path:gu(a("pelvis"),Yt(.3*t))},h=Vn(qo(c.path,0)),u=Vn(qo(c.path,2));return c.ground=h.map((f,d)=>Math.hypot(f,u[d])*t),{seconds:e/t,...dy(i),...py(c),...my(c),...yy(c),...xy(c),...vy(c)}}function dy(i){let t=i.quaternions,e=88,n=0,s=0;for(let r=e;r<t.length;r+=4){let a=r-e,o=Math.abs(t[r]*t[a]+t[r+1]*t[a+1]+t[r+2]*t[a+2]+t[r+3]*t[a+3]);n+=Math.acos(Math.min(o,1))}for(let r=0;r<i.frames;r++){let[a,o,l,c]=t.subarray(r*e,r*e+4),h=i.root[r*3+1];(1-2*(o*o+c*c))/Math.max(a*a+o*o+l*l+c*c,1e-9)>.3&&h>.2&&h<2&&s++}return{angularSpeed:2*n/(t.length/4-22)*i.fps,upright:s/i.frames}}function py({fps:i,heading:t,path:e,seen:n}){let s=[],r=[],a=[];for(let p=0;p+1<e.length;p++){let[g,y]=[e[p+1][0]-e[p][0],e[p+1][2]-e[p][2]],[w,b]=[Math.sin(t[p]),Math.cos(t[p])];s.push(g*w+y*b),r.push(g*b-y*w),a.push(Math.hypot(g,y))}let o=a.map(p=>p*i>.12),l=p=>p.filter((g,y)=>o[y]),c=Math.max(l(a).length/i,.5),h=[0,1,2].map(p=>e[e.length-1][p]-e[0][p]),[u,f]=[Math.sin(t[0]),Math.cos(t[0])],d=[Ls(r),Ls(s)],m=Math.max(Math.hypot(...d),1e-6),_=Qn(n("l_ankle"),n("r_ankle")).map(p=>(p[0]*d[0]+p[2]*d[1])/m);return{forward:d[1],lateral:d[0],forwardNet:h[0]*u+h[2]*f,lateralNet:h[0]*f-h[2]*u,forwardSpeed:Ls(l(s))/c,lateralSpeed:Ls(l(r))/c,cruise:o.some(Boolean)?An(l(a),70)*i:0,stride:(An(_,97)-An(_,3))/2,yaw:t[t.length-1]-t[0]}}var Zp=()=>Math.abs(Ee.offsets[Se.l_elbow][0])+Math.abs(Ee.offsets[Se.l_wrist][0]);function my({fps:i,joint:t,seen:e}){let n={handPeak:[],handTravel:[],handSwings:[]};for(let s of"lr"){let r=Qn(t(`${s}_wrist`),t(`${s}_shoulder`)).map(o=>o[1]/Zp()),a=Qn(e(`${s}_wrist`),e("spine3"));n.handPeak.push(An(r,95)),n.handTravel.push(Ls($o(Qn(a.slice(1),a.slice(0,-1))))),n.handSwings.push(gy(a.filter((o,l)=>r[l]>-.1)))}return n}function gy(i){if(i.length<4)return 0;let t=Qn(i,gu(i,31)),e=[0,1,2].map(r=>Ls(qo(t,r))/t.length),n=[0,1,2].map(r=>[0,1,2].map(a=>Ls(t.map(o=>(o[r]-e[r])*(o[a]-e[a]))))),s=_y(n).slice(0,2).map(r=>{let a=t.map(o=>o[0]*r[0]+o[1]*r[1]+o[2]*r[2]);return Li(a,.03,-.03)+Li(a.map(o=>-o),.03,-.03)});return Math.max(...s)}function _y(i){let t=i.map(n=>[...n]),e=[[1,0,0],[0,1,0],[0,0,1]];for(let n=0;n<30;n++)for(let[s,r]of[[0,1],[0,2],[1,2]]){if(Math.abs(t[s][r])<1e-300)continue;let a=(t[r][r]-t[s][s])/(2*t[s][r]),o=Math.sign(a||1)/(Math.abs(a)+Math.hypot(a,1)),l=1/Math.hypot(o,1),c=o*l;for(let h of[t,e])for(let u of h)[u[s],u[r]]=[l*u[s]-c*u[r],c*u[s]+l*u[r]];for(let h=0;h<3;h++)[t[s][h],t[r][h]]=[l*t[s][h]-c*t[r][h],c*t[s][h]+l*t[r][h]]}return[0,1,2].sort((n,s)=>t[s][s]-t[n][n]).map(n=>e.map(s=>s[n]))}function yy({fps:i,heading:t,joint:e,seen:n,up:s,ground:r}){let a=[];for(let y of"lr"){let w=Qn(e(`${y}_wrist`),e(`${y}_shoulder`)),b=$o(w),E=b.map(F=>F/Zp()),T=Qn(n(`${y}_wrist`),n(`${y}_shoulder`)),x=ya(Vn(E).map(F=>+(F*i>1.5)),Yt(.4*i)),A=E.map((F,L)=>Math.abs(w[L][0]*s[L][0]+w[L][1]*s[L][1]+w[L][2]*s[L][2])<.6*b[L]&&T[L][2]>.25&&x[L]>.05?F:Math.min(F,.7));a.push(Li(A,.85,.72))}let o=$o(Qn(e("l_wrist"),e("r_wrist"))),[l,c]=[n("l_wrist"),n("r_wrist")],h=o.map((y,w)=>(l[w][2]+c[w][2])/2>.12&&(l[w][1]+c[w][1])/2>.05?-y:-1),u=e("pelvis"),f=s.map((y,w)=>{let b=y[0]*Math.sin(t[w])+y[2]*Math.cos(t[w]),E=Math.asin(Math.min(Math.max(b,-1),1))*180/Math.PI;return u[w][1]>.83*Is&&r[w]<.5?E:Math.min(E,25)}),d=Math.max(Yt(i/3),1),m=Math.floor(d/2),_=ya(o.map(y=>+(y<.3)),d),p=l.map((y,w)=>y.map((b,E)=>(b+c[w][E])/2)),g=$o(Qn(p.slice(d),p.slice(0,-d))).map((y,w)=>_[w+m]>.99?y:0);return{punches:a,claps:Li(h,-.17,-.24),slashes:Li(g,.4,.2),bows:Li(ya(f,5),35,18)}}function xy({joint:i,seen:t}){let e=Qn(i("l_ankle"),i("r_ankle")).map(s=>s[1]);return{kicks:[["l",e],["r",e.map(s=>-s)]].map(([s,r])=>{let a=t(`${s}_ankle`);return Li(r.map((o,l)=>a[l][2]>.3?o:Math.min(o,.2)),.33,.25)})}}function vy({fps:i,joint:t,seen:e,ground:n}){let s=t("pelvis").map(u=>u[1]),r=t("l_foot").map((u,f)=>Math.min(u[1],t("r_foot")[f][1])),a=An(r,10),o=r.map(u=>u-a),l=Qn(e("l_ankle"),e("r_ankle")),c=o.map((u,f)=>s[f]>Is+.03&&Math.hypot(l[f][1],l[f][2])<.3&&n[f]<2.6?u:0),h=o.map((u,f)=>u<.06?Is-s[f]:0);return{squats:Li(h,.27,.12),jumps:Li(c,.05,.02),pelvisLow:fy(s)[0]/Is,flight:o.filter(u=>u>.03).length/i}}var Yo=.7,Jp=.06,My=i=>i.upright>.9&&i.angularSpeed>.02&&i.angularSpeed<6,Kp=(i,t,e)=>t>.3&&e>.17&&i.stride>Jp,by=i=>Kp(i,i.forward,i.forwardSpeed)&&Math.abs(i.lateral)<.6*i.forward,Wp=(i,t)=>Kp(i,t*i.lateral,t*i.lateralSpeed/.7)&&t*i.lateral>.25*Math.abs(i.forward),Zo=(i,t)=>i.handPeak[t]>-.2&&i.handTravel[t]>.15,Xp=(i,t)=>Zo(i,t)&&i.handPeak[t]-i.handPeak[1-t]>.35,wy=i=>{let t=i.handPeak[1]>i.handPeak[0]?1:0;return Zo(i,t)&&i.handSwings[t]>=4},Sy=i=>by(i)&&(i.cruise>2||i.flight>.05*i.seconds&&i.cruise>1.3),_u=(i,t)=>Math.hypot(i.forwardNet,i.lateralNet)>t*i.seconds,jp=(i,t)=>Math.abs(i.forwardNet)<t&&Math.abs(i.lateralNet)<t,Ey=i=>i.cruise<2&&i.flight<.05*i.seconds&&(_u(i,.25)||Math.abs(i.yaw)>Yo&&i.cruise>.5)&&i.stride>Jp&&i.pelvisLow>.82,Ay=i=>(Wp(i,1)||Wp(i,-1))&&Math.abs(i.lateralNet)>Math.abs(i.forwardNet),Ty=i=>Math.abs(i.yaw)>Yo&&jp(i,.6)&&Math.max(...i.handPeak)<-.3,Ry=i=>Math.abs(i.forward)<.4&&Math.abs(i.lateral)<.4&&Math.max(...i.handPeak)<-.3&&Math.abs(i.yaw)<.5&&i.angularSpeed<1&&i.pelvisLow>.9&&i.stride<.1&&i.bows===0,$p=i=>Zo(i,0)||Zo(i,1),Qp=i=>Object.fromEntries(Object.entries(i).map(([t,e])=>[t,n=>My(n)&&e(n)])),tm=Qp({walk:Ey,run:Sy,wave:wy,"side-step":Ay,turn:Ty,stand:Ry,"crouch-walk":i=>i.pelvisLow<.85&&_u(i,.2),spin:i=>Math.abs(i.yaw)>4.7&&jp(i,.8),kick:i=>Math.max(...i.kicks)>=1,punch:i=>Math.max(...i.punches)>=1&&!_u(i,.25),slash:i=>i.slashes>=1,raise:$p,bye:$p,squat:i=>i.squats>=1,jump:i=>i.jumps>=1,clap:i=>i.claps>=1,bow:i=>i.bows>=1}),qp=Qp({"turn-left":i=>i.yaw>Yo,"turn-right":i=>-i.yaw>Yo,"left-hand":i=>Xp(i,0),"right-hand":i=>Xp(i,1),"kick-left":i=>i.kicks[0]>i.kicks[1],"kick-right":i=>i.kicks[1]>i.kicks[0],"punch-left":i=>i.punches[0]>i.punches[1],"punch-right":i=>i.punches[1]>i.punches[0]});function em(i,t,e){let n=i==="spin"?`turn-${t}`:`${i}-${t}`;return qp[n]??(e?qp[`${t}-hand`]??null:null)}var Yp=([i,t],e)=>e==="left"?i:e==="right"?t:i+t,jo={bow:i=>i.bows,clap:i=>i.claps,jump:i=>i.jumps,squat:i=>i.squats,kick:(i,t)=>Yp(i.kicks,t),punch:(i,t)=>Yp(i.punches,t)},nm=(i,t,e)=>jo[i]?.(t,e)??null;var Cy=.5,im=.12,Py=.4,Iy=.01,Ly=.08,Ny=.5,Dy=-3,Oy=2,Uy=.2,Fy=2/30,By=3/30,ky=8/30,zy=12/30,Gy=9/30,Vy=8/30,Hy=.1,Wy=.1,xa=.01,Xy=.05,$y=.005,xu=.22,qy=2.5,Yy=[0,.5,1],Qo=.9,Zy=150;function sm(i,t,e,n,s){let r=Jy(i,s,n),a=i.map((u,f)=>u.map((d,m)=>Pe(d,r[f][m]))),o=Ky(a,t,e,n),l=jy(t,n),c=o.map(u=>u.map((f,d)=>f&&l[d])),h=o.map(u=>u.map((f,d)=>f&&!l[d]));return tx(a,t,h,n,s).forEach((u,f)=>{let d=ox(a[f],u,s[f],c[f],n);r[f]=r[f].map((m,_)=>Pe(m,d[_]));for(let m of u)c[f].fill(!0,m.start,m.stop)}),{shifts:r,planted:c}}function Jy(i,t,e){let n=i[0].length,s=Array.from({length:n},(r,a)=>Math.min(i[0][a][1],i[1][a][1])-Kn);return s=Hp(s,2*Yt(Py*e)+1),s=s.map(r=>Math.sign(r)*Math.max(Math.abs(r)-Iy,0)),s=s.map(r=>r*Jn(2-Math.abs(r)/im,0,1)),t.map(r=>{let a=pu(r.map(Number),2*Yt(.2*e)+1);return En(s.map((l,c)=>l*(1-a[c])),.1*e).map((l,c)=>[0,r[c]?0:-l,0])})}function Ky(i,t,e,n){let s=i.map(c=>c.map(h=>h[1]-Kn)),r=s.map((c,h)=>c.map((u,f)=>e[h][f]>Cy&&u<im));if(i[0].length<2)return r;let a=s.map(c=>Vn(c).map(h=>Math.abs(h)*n)),o=En(t[0].map((c,h)=>(c[1]+t[1][h][1])/2),.05*n),l=Vn(Vn(o)).map(c=>c*n*n<Dy);return r.map((c,h)=>c.map((u,f)=>{if(u)return!0;let d=s[0][f]<=s[1][f]?0:1,m=s[h][f]<Ly&&a[h][f]<Ny&&!l[f];return!r[0][f]&&!r[1][f]&&m&&d===h}))}function jy(i,t){if(i[0].length<2)return i[0].map(()=>!1);let e=[0,2].map(n=>Vn(i[0].map((s,r)=>(s[n]+i[1][r][n])/2)));return En(e[0].map((n,s)=>Math.hypot(n,e[1][s])*t),Uy*t).map(n=>n>=Oy)}function Qy(i,t){let e=[];for(let n=0,s=-1;n<=i.length;n++)if(i[n]&&s<0&&(s=n),!i[n]&&s>=0){let r=e[e.length-1];r&&s-r[1]<=t?r[1]=n:e.push([s,n]),s=-1}return e}function tx(i,t,e,n,s){let r=e[0].map((o,l)=>(e[0][l]||e[1][l])&&!s[0][l]&&!s[1][l]),a=new vu(i,t,r,n,s);for(let[o,l,c]of ex(i,e,n,s))a.stand(o,l,c);return a.stepOn(i[0].length,null),a.found}var vu=class{constructor(t,e,n,s,r){Object.assign(this,{balls:t,hips:e,free:n,fps:s,kept:r,found:[[],[]],until:0,last:0}),this.shortest=Math.min(Yt(By*s),t[0].length),this.swing=Yt(ky*s),this.sooner=Yt(zy*s)}stand(t,e,n){this.stepOn(t,n),this.gap(t)&&t-this.until<=this.sooner&&(t=Math.max(this.ready(n),Math.min(t,this.until))),this.plant(t,e,n)}stepOn(t,e){for(;this.gap(t)&&(t-this.until>this.sooner||e===null||e===this.last);){let n=this.until,s=1-this.last;if(this.plant(this.ready(s),s===e?t-this.swing:t,s),this.until===n)break}}gap(t){return this.until<t&&this.free.slice(this.until,t).every(Boolean)}ready(t){let e=this.found[t];return Math.max(this.until,e.length?e[e.length-1].stop+this.swing:0)}plant(t,e,n){let s=this.balls[n],r=this.hips[n],a=[];for(let h=t;h<e;h++)this.kept[n][h]&&a.push(h-t);let o,l,c;if(a.length)o=Mu(s[t+(a[0]===0?a[a.length-1]:a[0])]),[l,c]=ax(o,r,t,e);else{if(e-t<this.shortest)return;[o,l,c]=rx(s,r,t,e,this.shortest)}a.length||(l=this.landing(o,l,n)),c-l>=this.shortest&&(this.found[n].push({start:l,stop:c,point:o}),c>this.until&&(this.until=c,this.last=n))}landing(t,e,n){let s=this.found[n].at(-1);if(!s)return e;let r=Math.hypot(...t.map((c,h)=>c-s.point[h])),a=Math.ceil(Math.sqrt(6*r/Zy)*this.fps),o=Math.min(e-a,s.stop);return o===s.stop?e:this.kept[n].slice(Math.max(o,0),s.stop).some(Boolean)||o-s.start<this.shortest?s.stop+a:(s.stop=o,e)}};function ex(i,t,e,n){let s=[];for(let r of[0,1])for(let[a,o]of nx(t[r],i[r],e)){let c=n[r].slice(a,o).some(Boolean)?[[a,o]]:ix(i[r].slice(a,o),a,e,.5*r);for(let[h,u]of c)s.push([h,u,r])}return s.sort((r,a)=>r[0]-a[0]||r[1]-a[1]||r[2]-a[2])}function nx(i,t,e){let n=[];for(let[s,r]of Qy(i,0)){let a=n[n.length-1];(a?Math.hypot(t[s][0]-t[a[1]-1][0],t[s][2]-t[a[1]-1][2]):1/0)<=xu&&s-a[1]<=Yt(Fy*e)?a[1]=r:n.push([s,r])}return n}function ix(i,t,e,n){let s=[[t,t+i.length]],r=i.map(w=>w[0]),a=i.map(w=>w[2]),o=w=>w.reduce((b,E)=>b+E,0)/w.length,[l,c]=[o(r),o(a)];if(Math.max(...r.map((w,b)=>Math.hypot(w-l,a[b]-c)))<=xu)return s;let[h,u]=[En(r,.1*e),En(a,.1*e)],f=[0];for(let w=1;w<h.length;w++)f.push(f[w-1]+Math.hypot(h[w]-h[w-1],u[w]-u[w-1]));let d=Yt(Vy*e),m=f[f.length-1],_=Math.min(Math.ceil(m/(2*xu)),Math.floor(i.length/(2*d)));if(_<2)return s;let p=Math.floor(d/2),g=[-p];for(let w=1;w<=_;w++){let b=(w-n)/_;b<1-1e-9&&g.push(sx(f,b*m))}g.push(i.length+p);let y=[];for(let w=1;w<g.length;w++){let[b,E]=[g[w-1]+p,g[w]-p];E>b&&y.push([t+Math.max(b,0),t+Math.min(E,i.length)])}return y}function sx(i,t){let e=i.findIndex(n=>n>=t);return e<0?i.length:e}var Mu=i=>[i[0],Kn,i[2]];function bu(i,t,e){let n=[0,0,0];for(let s=t;s<e;s++)n=Pe(n,i[s]);return De(n,1/(e-t))}function rx(i,t,e,n,s){for(let r=e;r<=n-s;r++)for(let a=n;a>=r+s;a--){let o=bu(i,r,a),l=bu(t,r,a);for(let c of Yy){let h=Mu(Pe(De(o,1-c),De(l,c))),u=0;for(let f=r;f<a;f++)u=Math.max(u,jt(Ne(t[f],h)));if(u<=Qo)return[h,r,a]}}return[Mu(i[e]),e,e]}function ax(i,t,e,n){let s=t.slice(e,n).map(l=>jt(Ne(l,i))),r=s.indexOf(Math.min(...s));if(s[r]>Qo)return[e,e];let a=r,o=r+1;for(;a>0&&s[a-1]<=Qo;)a--;for(;o<s.length&&s[o]<=Qo;)o++;return[e+a,e+o]}function ox(i,t,e,n,s){let r=i.length,a=i.map(()=>[0,0,0]),o=[...e],l=new Array(r).fill(0);for(let h of t){let u=i.slice(h.start,h.stop),f=e.slice(h.start,h.stop).some(Boolean)?null:lx(u,s);u.forEach((d,m)=>{let _=Ne(h.point,d);f&&(_[0]+=f[m][0],_[2]+=f[m][2]),_[1]=Jn(d[1],Kn,Kn+$y)-d[1],a[h.start+m]=_,o[h.start+m]=!0})}e.forEach((h,u)=>{h&&(a[u]=[0,0,0])});for(let h=1;h<t.length;h++){let[u,f]=[t[h-1],t[h]];if(n.slice(u.stop,f.start).some(Boolean))continue;let d=f.start-u.stop,m=Math.min(Hy,Wy*jt(Ne(f.point,u.point)));for(let _=0;_<d;_++)l[u.stop+_]=m*Math.sin(Math.PI*(_+1)/(d+1))**2}a=cx(a,o,Yt(Gy*s),s);for(let h=0;h<r;h++){if(o[h]||l[h]===0)continue;let u=l[h]-(i[h][1]+a[h][1]-Kn),f=Jn((u+xa)/(2*xa),0,1)**2*xa;a[h][1]+=(u<xa?f:u)*Math.min(l[h]/xa,1)}return hx(i.map((h,u)=>h[1]+a[u][1]),o,s).forEach((h,u)=>{a[u][1]+=h}),a}function lx(i,t){let e=bu(i,0,i.length),n=i.map(r=>[r[0]-e[0],0,r[2]-e[2]]),s=0;for(let r=1;r<n.length;r++)s+=jt(Ne(n[r],n[r-1]));return s=s*t/Math.max(i.length-1,1),n.map(r=>De(r,Math.min(1,Xy/Math.max(s,1e-9))))}function cx(i,t,e,n){let s=i.map(c=>[...c]),r=qy/n,a=s.length,o=[0,0,0],l=(c,h)=>{let u=c>=0&&c<a?s[c]:o,f=o;return Math.min(c,h)>=0&&Math.max(c,h)<a&&t[h]&&(f=De(Ne(s[c],s[h]),c-h)),[u,f.map(d=>Jn(d,-r,r))]};for(let c=0;c<a;c++){if(t[c])continue;let h=c;for(;h<a&&!t[h];)h++;let[u,f]=l(c-1,c-2),[d,m]=l(h,h+1),_=h-c+1;if(c>0&&h<a&&_<=2*e){let p=yu(u,d,f,m,_);for(let g=c;g<h;g++)s[g]=p[g-c+1]}else{let p=yu(u,o,f,o,e),g=yu(o,d,o,m,e);for(let y=c,w=1;y<h;y++,w++)c>0&&(s[y]=Pe(s[y],p[Math.min(w,e)])),h<a&&(s[y]=Pe(s[y],g[Math.max(w-_+e,0)]))}c=h}return s}function yu(i,t,e,n,s){return Array.from({length:s+1},(r,a)=>{let o=a/s,l=o*o,c=l*o;return[0,1,2].map(h=>(2*c-3*l+1)*i[h]+(c-2*l+o)*s*e[h]+(3*l-2*c)*t[h]+(c-l)*s*n[h])})}function hx(i,t,e){let n=i.map((r,a)=>t[a]?0:Math.max(Kn-r,0));if(!n.some(Boolean))return n;let s=2*Yt(.1*e)+1;return En(pu(n,s),s/6).map((r,a)=>t[a]?0:r)}var ux=1e-4,fx=1.5/30,dx=.5/30,px=10,mx=.995,gx=.97,_x=.8,rm=.02,yx=.1;function om(i){let t=i.length/It;return ci.map(([e,n,s])=>Array.from({length:t},(r,a)=>[e,n,s].some(o=>{for(let l=0;l<6;l++)if(i[a*It+o*6+l])return!0;return!1})))}var xx=i=>[0,1].map(()=>new Array(i).fill(!1));function el(i,t=null){let e=i.frames,n=Array.from({length:e},(u,f)=>Ln(i,f)),s=ma.map(({ball:u})=>n.map(({positions:f})=>f[u])),r=ci.map(([u])=>n.map(({positions:f})=>f[u])),a=[0,1].map(u=>Array.from({length:e},(f,d)=>i.contacts[d*2+u])),{shifts:o,planted:l}=sm(s,r,a,i.fps,t??xx(e)),c=i.quaternions.slice(),h=new Float32Array(e*2);for(let u of[0,1])for(let f=0;f<e;f++)if(h[f*2+u]=t?.[u][f]?a[u][f]:Number(l[u][f]),!(jt(o[u][f])<=ux))for(let[d,m]of vx(u,n[f],o[u][f])){let _=(f*qt+d)*4,p=0;for(let g=0;g<4;g++)p+=m[g]*i.quaternions[_+g];c.set(p<0?m.map(g=>-g):m,_)}return{...i,quaternions:c,contacts:h}}function vx(i,{positions:t,world:e},n){let[s,r,a,o]=ci[i],l=Pe(t[o],n),c=Ne(t[a],t[o]),h=Math.max(jt(Ne(t[a],t[s])),gx*lr),u=bx(t[s],l,c,h),[f,d]=wx(t[s],e[s],e[r],Ee.offsets[r],Ee.offsets[a],Pe(l,Je(u,c))),m=[e[Ee.parents[s]],f,d,we(u,e[a]),e[o]];return[s,r,a,o].map((_,p)=>[_,wn(we(xi(m[p]),m[p+1]))])}function lm(i,t=null){return am(el(am(el(i,t),fx,t),t),dx,t)}function am(i,t,e){let n=i.quaternions.slice(),s=qt*4;return ci.forEach((r,a)=>{for(let o of r){let l=new Float64Array(i.frames*4);for(let h=0;h<i.frames;h++)l.set(i.quaternions.subarray(h*s+o*4,h*s+o*4+4),h*4);Gn(l,4);let c=[0,1,2,3].map(h=>En(Array.from({length:i.frames},(u,f)=>l[f*4+h]),t*i.fps));for(let h=0;h<i.frames;h++){if(e?.[a][h])continue;let u=Math.hypot(...c.map(f=>f[h]));n.set(c.map(f=>f[h]/u),h*s+o*4)}}}),{...i,quaternions:n}}function cm(i,t,e){let n=t.quaternions.slice();return ci.forEach((s,r)=>{let a=Mx(e[r]);for(let o=0;o<t.frames;o++){let l=Math.min(a[o]/px,1),c=l*l*(3-2*l);for(let h of s){let u=(o*qt+h)*4;n.set(Ii(Array.from(i.quaternions.subarray(u,u+4)),Array.from(t.quaternions.subarray(u,u+4)),c),u)}}}),{...t,quaternions:Gn(n,qt*4)}}function Mx(i){let t=i.map(e=>e?0:1/0);for(let e=1;e<t.length;e++)t[e]=Math.min(t[e],t[e-1]+1);for(let e=t.length-2;e>=0;e--)t[e]=Math.min(t[e],t[e+1]+1);return t}function bx(i,t,e,n){let s=Ne(i,t),r=jt(e),a=jt(s),o=(r*r+a*a-n*n)/(2*r*a),l=Pi(e,s),c=Math.atan2(jt(l),li(e,s));return pa(Ze(l),Jn(c-Math.acos(Jn(o,-1,1)),0,_x))}function wx(i,t,e,n,s,r){let a=jt(n),o=jt(s),l=jt(Pe(Je(t,n),Je(e,s))),c=Math.max(l,mx*lr),h=1.05*Math.abs(a-o)+.05,u=jt(Ne(r,i)),f=Math.max(Math.min(u,c),Math.min(l,h));for(let d=0;d<2;d++){let m=Je(t,n),_=Pe(m,Je(e,s)),p=Sx(_,m,t),g=jt(_),y=tl(a,f,o)-tl(a,g,o),w=tl(a,o,f)-tl(a,o,g);t=we(pa(p,y),t),e=we(pa(p,y+w),e);let b=zp(Pe(Je(t,n),Je(e,s)),Ne(r,i));t=we(b,t),e=we(b,e)}return[t,e]}var tl=(i,t,e)=>Math.acos(Jn((i*i+t*t-e*e)/(2*i*t),-1,1));function Sx(i,t,e){let n=Pi(i,t),s=jt(n)/Math.max(jt(i)*jt(t),1e-9),r=Jn((s-rm)/(yx-rm),0,1),a=Ze(i),o=[-e[0],-e[3],-e[6]];return o=Ne(o,De(a,li(o,a))),Ze(Pe(De(Ze(n),r),De(Ze(o),1-r)))}function Ex(i,t){if(t.length===1)return i;let e=Me(i),n=t.length>>1,s=i.slice();for(let r=0;r<e;r++)for(let a=0;a<ue+cr;a++){let o=0;for(let l=-n;l<=n;l++)o+=t[l+n]*i[Math.min(Math.max(r+l,0),e-1)*It+a];s[r*It+a]=o}return s}var hm=(i,t,e)=>e.map((n,s)=>i[s]?t[s]:n);function Ax(i){let t=Me(i),e=i.slice(),n=new Float64Array(t),s=[];for(let r=0;r<t;r++)s.push(Cs(i,r*It)),n[r]=Vo(s[r]);Ps(n);for(let r=0;r<t;r++)fa(we(da(-n[r]),s[r]),e,r*It);return e}function Tx(i,t,e){if(t===null)return i;let n=qt*4,s=t/e,r=i.slice();for(let a=n;a<r.length;a+=4){let o=Array.from(r.subarray(a-n,a-n+4)),l=Go(ua(hu(o),Array.from(i.subarray(a,a+4)))),c=Math.hypot(...l);c>s&&r.set(ua(o,or(l.map(h=>h*s/c))),a)}return Gn(r,n)}function dr(i,t,{known:e=null,text:n="",place:s=hr,carried:r=!1}={}){let a=Ex(i,t.smoothing);e&&(a=hm(e,i,Ax(hm(e,i,a))));let o=Qi(a,s,n);if(o={...o,quaternions:Tx(o.quaternions,t.maxVelocity,Et)},!t.footLock)return o;let l=r?lm:el,c=e&&om(e);return!c||!c.some(h=>h.some(Boolean))?l(o):cm(o,l(o,c),c)}var Rx=.5,Cx={collar:[0,0,0],shoulder:[0,0,-1.37],elbow:[0,-.38,0],wrist:[0,0,0]};function wu(i,t=null,e=!1){let n=i.frames-1,s=[[[0,1]],[[n,-1]]].slice(0,e?1:2),r=t?.map(l=>[[l-1,-1],[l,1]])??s,a=Math.round(Rx*i.fps);if(i.frames<4*a)return i;let o=i.quaternions.slice();for(let l of r){let c=l.map(([h])=>Ln(i,h).positions);for(let[h,u]of[["l",1],["r",-1]])if(!c.every(f=>f[Se[`${h}_wrist`]][1]<f[0][1]))for(let[f,d]of l)for(let[m,_]of Object.entries(Cx)){let p=or([_[0],_[1]*u,_[2]*u]);for(let g=0;g<a;g++){let y=1-g/a,w=y**3*(10-15*y+6*y*y),b=((f+d*g)*qt+Se[`${h}_${m}`])*4;o.set(Ii(Array.from(o.subarray(b,b+4)),p,w),b)}}}return{...i,quaternions:Gn(o,qt*4)}}var Px=10;function Su(i,t,e=Px){let n=Me(i),s=Float64Array.from(i),r=ue+cr;for(let a of[!1,!0]){let o=c=>(a?n-1-c:c)*It,l=(c,h)=>t[o(c)+h];for(let c=1;c<n;c++){let h=new Uint32Array(r),u=new Float64Array(r);for(let d=0;d<r;d++){if(!l(c-1,d)||l(c,d))continue;let m=g=>o(g)+d,_=[],p=1;for(;c+p<n&&!l(c+p,d);)p++;p>1&&_.push(s[m(c+1)]-s[m(c)]),c>1&&_.push(l(c-2,d)?s[m(c-1)]-s[m(c-2)]:_[0]??0),u[d]=s[m(c-1)]+(_.length?_.reduce((g,y)=>g+y,0)/_.length:0),h[d]=p}let f=(d,m)=>{let _=c+d===n?e:Math.min(e,Math.max(1,d>>1));for(let p=0;p<Math.min(d,_);p++)m(o(c+p),1-(p/_)**3*(p/_*(6*p/_-15)+10))};for(let d=0;d<r;d+=6){let m=h.subarray(d,d+6);if(d<ue&&m[0]&&m.every(_=>_===m[0])){let _=we(Cs(u,d),xi(Cs(s,o(c)+d))),p=Go(wn(_));f(m[0],(g,y)=>fa(we(Ke(or(De(p,y))),Cs(s,g+d)),s,g+d))}else for(let[_,p]of m.entries()){if(!p)continue;let g=u[d+_]-s[o(c)+d+_];f(p,(y,w)=>{s[y+d+_]+=g*w})}}}}return Float32Array.from(s)}var um=0xffffffffn;function fm(i,t){let[e,n,s,r]=[i>>>16,i&65535,t>>>16,t&65535],a=e*r+(n*r>>>16),o=n*s+(a&65535);return e*s+Math.floor(a/65536)+Math.floor(o/65536)>>>0}function dm(i,t,e,n,s,r,a){for(let o=0;o<10;o++){let[l,c]=[fm(3528531795,i),fm(3449720151,e)],[h,u]=[Math.imul(3528531795,i)>>>0,Math.imul(3449720151,e)>>>0];[i,t,e,n]=[(c^t^s)>>>0,u,(l^n^r)>>>0,h],s=s+2654435769>>>0,r=r+3144134277>>>0}a[0]=i,a[1]=t,a[2]=e,a[3]=n}var pm=i=>[Number(BigInt(i)&um),Number(BigInt(i)>>32n&um)];function Eu(i,t){if(t===0)return BigInt(i);let e=[];return dm(t,0,0,4294967295,...pm(i),e),BigInt(e[0])+(BigInt(e[1]>>>1)<<32n)}function mm(i,t,e){let n=new Float32Array(e),s=Ix(new TextEncoder().encode(t)),r=[0,0,0,0],[a,o]=pm(i);for(let l=0;l<e;l+=4){dm(l>>>2,0,s,0,a,o,r);for(let c of[0,2]){let h=Math.sqrt(-2*Math.log((r[c]+.5)/4294967296)),u=2*Math.PI*(r[c+1]+.5)/4294967296;n[l+c]=h*Math.cos(u),n[l+c+1]=h*Math.sin(u)}}return n}function Ix(i){let t=-1;for(let e of i){t^=e;for(let n=0;n<8;n++)t=t>>>1^3988292384&-(t&1)}return~t>>>0}var nl=150,Ns=30,Lx=48,Tu=8,Au=10,Nx=.05,Dx=30,ti=i=>({values:new Float32Array(i*It),known:new Uint8Array(i*It),shown:new Uint8Array(i*It).fill(1)}),Ru=(i,t,e)=>({values:je(i.values,t,e),known:je(i.known,t,e),shown:je(i.shown,t,e)});function Ox(i,t){let e=t-Me(i.values);if(e<=0)return i;let n=ti(e);return{values:jn([i.values,n.values]),known:jn([i.known,n.known],Uint8Array),shown:jn([i.shown,n.shown],Uint8Array)}}function Ux(i,t,e,n){let s=1+Math.max(0,Math.ceil((i+t-e)/(e-n))),r=i+t+(s-1)*n,a=o=>Math.floor(r*o/s);return Array.from({length:s},(o,l)=>a(l+1)-a(l)-(l?n:t))}function Fx(i){let t=Me(i);if(t<Au)return!1;let e=Qi(je(i,t-Au,t));if(!Jo(e))return!1;let n=Array.from({length:Au},(s,r)=>Ln(e,r).positions);return["pelvis","l_ankle","r_ankle"].every(s=>[0,1,2].every(r=>{let a=n.map(o=>o[Se[s]][r]);return Math.max(...a)-Math.min(...a)<Nx}))}function Bx(i,t,e){let n=jn([new Uint8Array(i.length).fill(1),e.slice(0,t.length)],Uint8Array),s=Me(i);return je(Su(jn([i,t]),n,Dx),s,s+Me(t))}var Cu=i=>Array.from({length:Tu},(t,e)=>Eu(i,e));async function vi(i,t,e,n={}){let{constraint:s=null,window:r=nl,overlap:a=Ns,guidance:o,told:l}=n,c=new Float32Array,h=0,u=0,f=null,d=[];for(let m of t){let _=new Float32Array,p=[],g=m.afresh&&m.text!==f&&Fx(c)?new Float32Array:c;f=m.text;for(let y of Ux(m.frames,Me(g),Math.min(r,m.window??r),a)){let w=Me(g),b=h-w,E=s?Ru(s,b,h+y):ti(w+y);E.values.set(g),E.known.fill(1,0,g.length),E.shown.fill(1,0,g.length);let T=Ox(E,Lx),x=w>0||s,A=null,F=1/0,L=null;for(let H of[...p,...Cu(Eu(e,u))]){let Z=await i.sample(m.text,Me(T.values),H,x?T:null,o),P=je(Su(je(Z,0,w+y),E.known),w,w+y);!w&&c.length&&(P=Bx(c,P,E.known));let W=m.miss?m.miss(jn([_,P])):0;if(W<F&&(F=W,A=P,L=H),F<=0)break}let O=jn([c,A]);g=c=je(O,Math.max(0,Me(O)-a),Me(O)),_=jn([_,A]),p=m.window?[L]:[],h+=y,u++,d.push(A),l?.(h)}}return jn(d)}var gm="a person moves",Pu=i=>new Set(i.flatMap(t=>ga[t]??(t in Se?[t]:[])));function Iu(i,t,e,n){let s=new Uint8Array(i.length).fill(1),r=new Uint8Array(i.length).fill(n===null?1:0),a=new Set([...ga["left-leg"],...ga["right-leg"]]);for(let o=t;o<e;o++){let l=o*It;if(n===null){s.fill(0,l,l+It);continue}for(let c of n)s.fill(0,l+Se[c]*6,l+Se[c]*6+6);[...n].some(c=>a.has(c))&&s.fill(0,l+ue+cr,l+It)}return{values:i,known:s,shown:r}}function _m(i,t,e,n){let s=n!==null||e>=i.frames;return{constraint:Iu(du(i),t,e,n),place:fr(i,0),rejoin:s?null:{stop:e,place:fr(i,e)}}}function ym(i,t,e,n,s=!1){let r=ti(n),a=(o,l,c)=>{r.values.set(je(du(o),l,l+e),c*It),r.known.fill(1,c*It,(c+e)*It)};return i&&a(i,0,0),t&&a(t,t.frames-e,n-e),{constraint:r,place:i?fr(i,0):hr,rejoin:t&&s?{stop:n-e,place:fr(t,t.frames-e)}:null}}var kx=.95,zx=.08,Gx=4;function xm(i,t){let e=Qi(i),n=ur(e),s=Array.from({length:e.frames},(f,d)=>{let{positions:m}=Ln(e,d),[_,p]=[Math.sin(n[d]),Math.cos(n[d])],[g,,y]=m[0];return m.map(([w,b,E])=>[(w-g)*p-(E-y)*_,b,(w-g)*_+(E-y)*p])}),r=(f,d)=>f.map((m,_)=>Math.hypot(...m.map((p,g)=>p-d[_][g]))),a=s.map(f=>r(f,s[0]).reduce((d,m)=>d+m,0)/qt),o=a.findIndex(f=>f>=kx*Math.max(...a)),l=s.slice(o).findIndex(f=>Math.max(...r(f,s[o]))>zx),c=(l<0?s.length-o:l)-1,h=Math.PI/Math.max(c,Yt(Gx/2*Et)),u=ti(t);for(let f=0;f<t;f++){let d=f<o?f:Yt(o+c*(1-Math.cos(h*(f-o)))/2);u.values.set(je(i,Math.min(d,s.length-1),Math.min(d,s.length-1)+1),f*It);for(let m of[Sn,Nn,Xe])u.values[f*It+ue+m]=0}return u.known.fill(1,o*It),u}async function vm(i,t,e,n,s){let r=await il(i,t,e.constraint,n,s);if(!e.rejoin)return{features:r,known:e.constraint.known};let a=Vx(r,e);return{features:await il(i,t,a,n,s),known:a.known}}async function il(i,t,e,n,s={}){let r=Me(e.values),a=[];for(let f=0;f<r;f++)je(e.known,f,f+1).includes(0)&&a.push(f);if(!a.length)return e.values;let o=Math.max(0,a[0]-Ns),l=Math.min(r,a[a.length-1]+1+Ns),{miss:c,...h}=s,u=await vi(i,[{text:t,frames:l-o,miss:c}],n,{...h,constraint:Ru(e,o,l)});return jn([je(e.values,0,o),u,je(e.values,l,r)])}function Vx(i,{constraint:t,place:e,rejoin:{stop:n,place:s}}){let r=0;for(;t.known[r*It+ue+Sn];)r++;let a=Float64Array.from(je(i,0,n+1)),o=Array.from({length:n+1},(p,g)=>{let y=g<r?0:(g-r)/(n-r);return y**3*(y*(6*y-15)+10)}),l=Wo(a,e).heading,c=s.heading-l[n]+Math.PI,h=2*Math.PI,u=(c%h+h)%h-Math.PI;for(let p=0;p<n;p++)a[p*It+ue+Xe]+=u*(o[p+1]-o[p])*Et;let f=Wo(a,e),d=[s.x-f.path[n*3],s.z-f.path[n*3+2]],m=t.values.slice(),_=t.known.slice();for(let p=r;p<n;p++){let g=[0,2].map((E,T)=>(f.path[(p+1)*3+E]-f.path[p*3+E]+(o[p+1]-o[p])*d[T])*Et),[y,,w]=uu([g[0],0,g[1]],-f.heading[p]),b=p*It+ue;m[b+Sn]=w,m[b+Nn]=y,m[b+Xe]=a[b+Xe],_[b+Sn]=_[b+Nn]=_[b+Xe]=1}return{...t,values:m,known:_}}var Mm=.01,bm=.12,Sm=1.2,Em=.25,va=4,Hx=2,Wx=1.5,Xx=2.5,$x=4,qx=.1,wm=.4,Am=2,Yx=3e3,Zx=.12,Jx=.25,Kx=.4,Ma=i=>i.slice(1).map((t,e)=>[t[0]-i[e][0],t[1]-i[e][1]]),pr=i=>Ma(i).reduce((t,e)=>t+Math.hypot(...e),0);function Lu(i,{speed:t=Sm,seconds:e=null,facing:n=0}){if(pr(i)>Yx)throw Tm(pr(i)/va);let s=jx(i),r=Qx(s,Math.min(Math.max(t,Em),va)),a=t>Am?0:e===null?wm:Math.min(wm,e/8),o=Math.trunc(a*Et);e!==null&&(r=tv(s,r,e-2*o/Et));let l=r[r.length-1],c=mu(0,l,Math.max(2,Yt(l*Et)+1));c=[...new Array(o).fill(c[0]),...c,...new Array(o).fill(l)];let[h,u]=[s.map(d=>d[0]),s.map(d=>d[1])],f=c.map(d=>[Xo(d,r,h),Xo(d,r,u)]);return{points:f,headings:nv(ev(f).map(d=>d+n))}}function jx(i){let t=pr(i),e=[0];for(let h of Ma(i))e.push(e[e.length-1]+Math.hypot(...h));let n=e.map(h=>h/t),s=n.map((h,u)=>u===0||h>n[u-1]),r=n.filter((h,u)=>s[u]),a=i.filter((h,u)=>s[u]),o=mu(0,1,Math.max(3,Math.ceil(t/Mm)+1)),l=Math.min(Math.ceil(4*bm/Mm),o.length-1),c=[0,1].map(h=>{let u=o.map(m=>Xo(m,r,a.map(_=>_[h]))),f=u.length-1,d=[];for(let m=l;m>0;m--)d.push(2*u[0]-u[m]);for(let m of u)d.push(m);for(let m=1;m<=l;m++)d.push(2*u[f]-u[f-m]);return En(d,bm*f/t,"reflect").slice(l,l+u.length)});return o.map((h,u)=>[c[0][u],c[1][u]])}function Qx(i,t){let e=Ma(i),n=e.map(h=>Math.max(Math.hypot(...h),1e-9)),s=Ps(e.map(([h,u])=>Math.atan2(h,u))),r=n.length>1?Vn(s).map((h,u)=>Math.abs(h)/n[u]):[0];r=En(r,5);let a=r.map(h=>Math.min(Math.max(Math.min(Math.sqrt(Hx/Math.max(h,1e-6)),Xx/Math.max(h,1e-6)),Math.min(Em,t)),t)),o=a.length-1;if(t<=Am)for(let h of[0,o])a[h]=Math.min(a[h],qx);let l=(h,u)=>{a[h]=Math.min(a[h],Math.sqrt(a[u]**2+2*Wx*n[h]))};for(let h=1;h<=o;h++)l(h,h-1);for(let h=o-1;h>=0;h--)l(h,h+1);let c=[0];return n.forEach((h,u)=>c.push(c[u]+h/a[u])),c}function tv(i,t,e){let n=t.map(r=>r*e/t[t.length-1]),s=Ma(i).reduce((r,a,o)=>Math.max(r,Math.hypot(...a)/(n[o+1]-n[o])),0);if(!(e>0)||s>va)throw Tm(Math.max(e,0)*s/va||pr(i)/va);return n}var Tm=i=>new Error(`The path is too long for its time: give it ${i.toFixed(1)} seconds or more, or draw a shorter one.`);function ev(i){let t=Ma(i),e=t.map(r=>Math.hypot(...r)*Et>.05);e.some(Boolean)||e.fill(!0);let n=e.indexOf(!0),s=t.map((r,a)=>(e[a]&&(n=Math.max(n,a)),Math.atan2(...t[n])));return Ps(s),[...s,s[s.length-1]]}function nv(i){let t=Zx*Et,e=En(i,t),n=()=>Math.max(...e.slice(1).map((s,r)=>Math.abs(s-e[r])))*Et;for(;n()>$x&&t<i.length;)t*=1.25,e=En(i,t);return e}function Nu(i){let t=Array.from({length:Me(i)},(r,a)=>i[a*It+ue+Xe]),e=En(t,Kx*Et),n=t.map((r,a)=>r-e[a]),s=n.reduce((r,a)=>r+a,0)/n.length;return n.map(r=>r-s)}function Du({points:i,headings:t},e){let[n,s]=[Vn(i.map(u=>u[0])),Vn(i.map(u=>u[1]))],r=n.map((u,f)=>Math.hypot(u,s[f])),a=Math.max(...r,1e-9),o=i.length-1,l=0,c=e.map((u,f)=>(l+=u*r[f]/a)/Et),h=u=>c[0]+(c[o]-c[0])*u/o;return{points:i,headings:t.map((u,f)=>u+c[f]-h(f))}}function Ou({points:i,headings:t}){let e=ti(i.length);return i.forEach((n,s)=>{let r=Math.min(s,i.length-2),[a,o]=[(i[r+1][0]-i[r][0])*Et,(i[r+1][1]-i[r][1])*Et],[l,c]=[Math.sin(t[s]),Math.cos(t[s])],h=s*It+ue;e.values[h+Sn]=a*l+o*c,e.values[h+Nn]=a*c-o*l,e.values[h+Xe]=(t[r+1]-t[r])*Et,e.known[h+Sn]=e.known[h+Nn]=e.known[h+Xe]=1}),e}async function mr(i,t,e,n={}){let s=await vi(i,[{text:t,frames:90}],e,n),r=[],a=[0,0],o=Me(s),l=Array.from({length:o-30},(f,d)=>s[(d+30)*It+ue+_a]),c=An(l,50),h=0;for(let f=0;f<o;f++){let d=[s[f*It+ue+Sn],s[f*It+ue+Nn]];r.push(Math.hypot(...d)),d.forEach((m,_)=>{a[_]+=m/o}),h+=s[f*It+ue+Xe]/o}if(Math.hypot(...a)<Jx)return{speed:Sm,facing:0,turning:h,height:c};let u=-Yt(Math.atan2(a[1],a[0])/(Math.PI/2))*(Math.PI/2);return{speed:An(r,75),facing:u,turning:h,height:c}}var Bu=" 	,;.!?:()/+&|。、，！？：；（）「」…—–·-";var es="stands still",Uu="sits",iv="squats down";var Um=/\u23f8(?:([\d.]+)\u23f8)?/u;var Fm={action:"stand",certainty:3,arms:!1},ba={ups:[Fm,es],bends:[{action:"turn",certainty:3,arms:!1},"turns left"],posed:[{action:"raise",certainty:3,arms:!0},"raises both arms"]},wa=["walk","run","crouch-walk"],gr=["sit","kneel","meditate"],Rm=["raise","bow","squat"],sv=[["after_seconds",1],["later_seconds",1],["after_minutes",60],["later_minutes",60]],ei=0,sl=-14,Fu=-2,rv=8,ts=({action:i,certainty:t})=>t>ei?i:null,Cm=i=>i.replace(new RegExp(Um.source,"gu"),""),av=/[\u3040-\u30ff\u3400-\u9fff]/u,Pm=/(?<![^\s,;:.])(?:(?:step|schritt|paso|étape|etape|take|toma|prise)\s*)?(\p{Nd}\p{Nd}?)\s*[.):](?!\p{Nd})\s*/giu,Im=/\s+|(?<=[\u3040-\u30ff\u3400-\u9fff]{2})(?=[\u3040-\u30ff\u3400-\u9fff]{2})/gu,_r=i=>({text:i,count:1,degrees:null,metres:null,seconds:null,steps:null,meanwhile:"",side:"both",held:!1}),al=i=>i.count===1&&i.degrees===null&&i.metres===null&&i.seconds===null&&i.steps===null&&!i.meanwhile&&i.side==="both"&&!i.held;function Hn(i,t=Bu){let e=0,n=i.length;for(;e<n&&t.includes(i[e]);)e++;for(;n>e&&t.includes(i[n-1]);)n--;return i.slice(e,n)}var Di=i=>i.trim().split(/\s+/u).join(" ").normalize("NFKC"),ov=i=>i.slice(0,[...i].findLastIndex(t=>!Bu.includes(t))+1),Lm=i=>[...i].slice([...i].findIndex(t=>!Bu.includes(t))).join(""),ns=i=>i.toLowerCase().replaceAll("ß","ss").replaceAll("’","'").replaceAll("ı","i").normalize("NFD").replace(/\p{M}/gu,""),ku=/[\p{L}\p{N}_]+/gu;function zu(i,t){let e=t?ns:n=>n.toLowerCase().replaceAll("ß","ss");return` ${(Di(i).match(ku)??[]).map(e).join(" ")} `}var Ni=(i,t)=>[...i.matchAll(t)].map(e=>[e.index,e.index+e[0].length]),rl=(i,t,e=ei)=>Math.min(i.certainty,t.certainty)>e&&i.action!==t.action,Nm=({metres:i,steps:t,degrees:e})=>i!==null||t!==null||e!==null,Dm=(i,t)=>i!==t&&i!=="both"&&t!=="both";function Bm(i,t){let[e,n]=[i,t].map(({parts:r,passed:a,certainty:o})=>[r.length,-a,o]),s=e.findIndex((r,a)=>r!==n[a]);return s<0||e[s]>n[s]}var Om=i=>i.reduce((t,e)=>Bm(t,e)?t:e),yr=class{constructor({patterns:t,...e},n){let s=a=>n(ba[a][1]).action===ba[a][0].action;Object.assign(this,e,{learned:s,plainRead:n,read:a=>{let o=Object.keys(ba).find(l=>this.entire[l].test(a)&&s(l));return o?ba[o][0]:n(this.bared(a))}}),this.first={},this.each={},this.head={},this.entire={},this.there={};for(let[a,o]of Object.entries(t))this.first[a]=new RegExp(o,"iu"),this.each[a]=new RegExp(o,"giu"),this.head[a]=new RegExp(`^(?:${o})`,"iu"),a in ba&&(this.entire[a]=new RegExp(`^(?:${o})$`,"iu"))}clauses(t){let e=this.staying(Di(this.tidied(t))),n=[];for(let o of this.ordered(e)){let l=n.at(-1);for(let c=this.joined(o);c.length;){let[h,...u]=c,f=u.length?this.atOnce(h,u[0]):null,d=f??this.parted(h)??this.measured(h);n.push(l?this.asBefore(l,d):d),l=null,c=f?u.slice(1):u}}let s=n.filter(o=>o.text);s.length||(s=[_r(t)]);let{text:r}=s[0],a=this.learned("ups");return this.first.downs.test(r)&&gr.includes(this.read(r).action)?s.unshift({..._r(es),seconds:.8}):a&&gr.includes(this.read(Uu).action)&&(this.first.ups.test(r)?s.unshift({..._r(Uu),seconds:.8}):r===es&&s.length===2&&this.first.ups.test(s[1].text)&&(s[0]={...s[0],text:Uu})),s.map(o=>this.inPlainWords(o,s.length===1))}inPlainWords(t,e){let{text:n,meanwhile:s}=t;(s||!e)&&(n=this.bared(n)),this.learned("ups")&&(n=n.replace(this.first.ups,es)),!e&&this.first.bends.test(n)&&this.learned("bends")&&ts(this.plainRead(n))!=="turn"&&(n=n.replace(this.first.bends,`turns ${this.sideOf(n)}`)),this.entire.posed.test(s)&&this.learned("posed")&&ts(this.plainRead(s))!=="raise"&&(s=`raises ${t.side} arm${t.side==="both"?"s":""}`);let r=t.metres===null&&t.degrees===null?this.placeKept(n):null;if(r){let a=this.without(n,r);if(wa.includes(ts(this.plainRead(a))))return{...t,text:a,meanwhile:s,metres:0}}return{...t,text:n,meanwhile:s}}bared(t){let e=t.replace(this.first.subject,"");return e!==t&&!ts(this.plainRead(t))&&ts(this.plainRead(e))?e:t}whole(t,e){let n=this.tidied(t),[{text:s}]=e;return e.length===1&&al(e[0])&&s!==this.trimmed(Di(n))?s:n}staying(t){for(let e=0;;){let n=["held","halts"].map(p=>this.match(p,t,e)).filter(Boolean);if(!n.length)return t;let s=n.reduce((p,g)=>g.index<p.index?g:p),r=s.index+s[0].length,a=this.lasting(t,r),o=a?a[0]:r,l=t.slice(0,s.index),c="",h=l.slice(l.lastIndexOf(" → ".trim())+1),u=Ni(h,this.each.joint).at(-1),f=[u?h.slice(u[1]):h,h].map(p=>ts(this.reading(this.trimmed(p)))).find(Boolean)??null;/[不没别勿]/u.test(l.slice(-4))&&(f=null);let[d,m]=["held","halts"].map(p=>this.match(p,t,s.index,!0));if(d&&f==="crouch-walk"&&(ts(this.reading(this.trimmed(h+s[0])))==="squat"||this.first.crouches.test(h))&&([l,f]=[l.slice(0,l.length-h.length)+iv,"squat"]),d&&Rm.includes(f)?c=a?`⏸${a[1]}⏸`:"⏸":d&&gr.includes(f)?c=a?` for ${1.5+a[1]} seconds`:" ":m&&f&&![...Rm,...gr].includes(f)&&(c=` → ${es} for ${a?a[1]:2.5} seconds`),e=r,!c)continue;let _=Hn(t.slice(o));t=`${l}${c}${_?" → ":""}${_}`,e=l.length+c.length}}match(t,e,n,s=!1){let r=s?this.there[t]??=new RegExp(this.each[t].source,"iuy"):this.each[t];r.lastIndex=n;let a=r.exec(e);return r.lastIndex=0,a}lasting(t,e){e+=t.length-e-t.slice(e).trimStart().length;for(let n of["seconds","minutes"]){let s=this.match(n,t,e,!0);if(s)return[e+s[0].length,this.measured(s[0]).seconds??0]}return null}asBefore(t,e){if(e.degrees!==null||!this.first.sideways.test(e.text))return e;let[n,s]=[e,t].map(({text:a})=>this.first.left.exec(a)??this.first.right.exec(a));if(!n||!s||this.first.no_side.test(t.text))return e;let{text:r}=t;return{...e,text:r.slice(0,s.index)+n[0]+r.slice(s.index+s[0].length)}}tidied(t){let e=this.withoutManners(t);return e===Di(t)?t:e}withoutManners(t){let e=Di(t.replace(/([\u2460-\u2468])/gu," $1) "));e=e.replace(this.first.greeting,""),e=(e.replace(this.first.closing,"")||e).replace(this.each.short,o=>o.slice(0,-1)),e=e.replace(this.first.halt_alone,es),e=e.replace(this.each.idiom,o=>this.plainly[ns(o)]),e=e.replace(this.each.goal,(...o)=>{let l=Di(o.at(-1).way).toLowerCase();return this.plainly[l]??this.plainly[ns(l)]}),e=Lm(e.replace(this.each.instead,(o,...l)=>l.find(Number.isInteger)&&/[,;，、]$/u.test(o.trimEnd())?", ":""))||e;let n=e;e=e.replace(this.each.undone,(o,...l)=>{let c=l.find(Number.isInteger),h=n.slice(0,c),u=Hn(n.slice(c+o.length));return this.first.arms.test(h)?this.first.held.test(`${h},`)?` → ${es} for ${1.5} seconds${u?" → ":""}`:"":o}),e=e.replace(this.each.late,"$<pause> $<verb> $<rest>");for(let[o,l]of sv)e=e.replace(this.each[o],(...c)=>{let{number:h,half:u}=c.at(-1),f=(this.value(h)+(u?.5:0))*l;return f?` → ${es} for ${f} seconds → `:c[0]});if(e.startsWith(" → ".trimStart())&&(e=e.slice(" → ".trimStart().length)),e.endsWith(" → ")){let o=e.slice(0,-3).split(" → "),l=o.pop();e=[...o.slice(0,-1),l,...o.slice(-1)].join(" → ")}let s=[...e.matchAll(Pm)],[r]=s;if(s.length<2||!s.every((o,l)=>Number(o[1])===l+1))return e;let a=e.slice(0,r.index).trim();return(/[:：]$/u.test(a)||a.split(/\s+/u).filter(Boolean).length<3)&&(e=e.slice(r.index+r[0].length)),e.replace(Pm," → ")}ordered(t){let e=this.head.after.exec(t),n=e?null:this.head.before.exec(t),s=e??n,r=s&&this.subordinate(t.slice(s[0].length));r&&!this.isTime(t,0,r[0])&&(r=null),n&&r?.reverse();for(let[a,o]of[["beforehand",!0],["then",!1],["earlier",!1],["later",!0],["before",!1],["after",!0]])for(let[l,c]of r?[]:Ni(t,this.each[a])){let h=t.slice(0,l),u=t.slice(c);if(a==="then"&&this.beginsAfter(t,l,c))continue;let f=a==="before"||a==="after";if(f&&this.first.ended.test(h)&&this.first.comma.test(u.trimStart().slice(1))){r=[h,t.slice(l)];break}if(!(f&&!this.isTime(t,l,u))&&(a==="then"&&/^\s*\p{L}/u.test(t.slice(l,c))&&([h,u]=this.around(h,u,t.slice(l,c))),!(!Hn(h)||!Hn(u)))){r=o?[u,h]:[h,u];break}}return r?r.flatMap(a=>this.ordered(a)):[this.trimmed(this.head.then.test(t)?t.replace(this.each.then," "):t)]}beginsAfter(t,e,n){let s=t.slice(e,n),r=Lm(s),a=this.head.after.exec(t.slice(n-r.length)),o=a===null?"":t.slice(n-r.length+a[0].length);return a===null||this.head.seconds.test(o)||this.head.minutes.test(o)?!1:a[0].trimEnd().length>ov(r).length}isTime(t,e,n){if(!this.head.noun.test(t.slice(e)))return!0;let{action:s,certainty:r}=this.reading(this.trimmed(n.split(this.first.stop)[0]));return s===null||r>ei}subordinate(t){let e=Ni(t,this.each.comma);if(!e.length)return this.best(t,Ni(t,Im));let n=this.best(t,e)??[t.slice(0,e[0][0]),t.slice(e[0][1])];return n.every(s=>Hn(s))?n:null}around(t,e,n){let s=Ni(t,this.each.joint).at(-1),r=s?t.slice(s[1]):"";return Hn(r)?Hn(e)&&!this.head.verb_then.test(n)&&(rl(this.read(this.trimmed(r)),this.read(this.trimmed(e)))||r.trim().split(/\s+/u).length>3||av.test(r))?[t,e]:[t.slice(0,s[0]),`${r.trimEnd()} ${e.trimStart()}`]:[t,e]}joined(t){let e=this.head.denial.exec(t)??this.first.refusal.exec(t),n=e&&this.trimmed(t.slice(0,e.index));if(e&&!(n&&this.read(n).certainty>ei)){let c=this.trimmed(t.slice(e.index+e[0].length)),h=this.reading(c),u=ts(this.read(this.trimmed(e[0])));(h.certainty>ei||c&&u&&u!==h.action)&&(t=c)}let s=[[0,0],...Ni(t,this.each.joint),[t.length,t.length]],r=s.slice(1).map(([c],h)=>[s[h][1],c]).filter(([c,h])=>Hn(t.slice(c,h))),a=r.map((c,h)=>this.isAside(t.slice(...c),!h)),o=[new Map([["",{parts:[],passed:0,certainty:0,action:null,side:"both",far:!1}]])];for(let c=1;c<=r.length;c++){let h=new Map([...o[c-1]].map(([u,f])=>[u,{...f,passed:f.passed+1}]));for(let u=Math.max(0,c-rv);u<c;u++){if(a[u]&&(u||a.slice(0,c).every(Boolean)))continue;let f=this.trimmed(t.slice(r[u][0],r[c-1][1])),d=this.measured(f),m=Nm(d),{action:_,certainty:p}=this.reading(f),g=this.sideOf(f),y=m&&wa.includes(_)||d.seconds!==null&&_==="stand",w=`${_} ${g} ${m}`,b=[...o[u].values()].filter(F=>F.action!==_||p>ei&&(Dm(F.side,g)||m&&F.far));if(!b.length||p<=(y?sl:ei))continue;let{parts:E,passed:T,certainty:x}=Om(b),A={parts:[...E,f],passed:T,certainty:x+p,action:_,side:g,far:m};(!h.has(w)||Bm(A,h.get(w)))&&h.set(w,A)}o.push(h)}let{parts:l}=Om([...o.at(-1).values()]);return l.length>1?l:[t]}isAside(t,e){let n=Hn(t.replace(this.each.aside," "));return!n||!e&&this.head.lacking.test(n)}best(t,e){let n=null,s=ei;for(let[r,a]of e){let o=[t.slice(0,r),t.slice(a)].map(h=>this.trimmed(h)),[l,c]=o.map(h=>this.reading(h));if(c===Fm&&rl(l,c))return o;rl(l,c,s)&&([n,s]=[o,Math.min(l.certainty,c.certainty)])}return n}atOnce(t,e){let n=[t,e].some(o=>this.first.meanwhile.test(o)||this.first.throughout.test(o)),s=this.pair(t,e,n?Fu:ei);if(!s)return null;let r=this.head.sign.test(e),a=this.first.manner.test(t)&&s.clause.meanwhile===t;return n||s.oneArmEach||!s.armsAlone&&(r||a)?s.clause:null}parted(t){let[e,n,s]=["meanwhile","joint","sign"].map(c=>Ni(t,this.each[c])),r=e.length>0||this.first.throughout.test(t),a=this.namesBoth(t),o=s.map(([c])=>[c,c]),l=[...o,...r||a?Ni(t,Im):[]];for(let[c,h,u]of[[e,sl,sl],[n,a?sl:Fu,Fu],[l,ei,ei]]){let f=null;for(let[d,m]of c){let _=this.pair(t.slice(0,d),t.slice(m),h),p=d===m&&o.some(([g])=>g===d);!_||!(_.oneArmEach||r&&_.certainty>u||p&&!_.armsAlone)||(!f||_.certainty>f.certainty)&&(f=_)}if(f)return f.clause}for(let[c,h]of Ni(t,this.each.posed)){let u=this.pair(`${t.slice(0,c).trimEnd()} ${t.slice(h).trimStart()}`,t.slice(c,h),ei);if(u&&(u.oneArmEach||!u.armsAlone))return u.clause}return null}namesBoth(t){let e=t.replace(this.each.no_side," ");return[this.first.left,this.first.right,this.first.other].filter(n=>n.test(e)).length>1}sides(t){let e=t.map(n=>this.sideOf(n));return t.forEach((n,s)=>{e[s]==="both"&&e[1-s]!=="both"&&this.first.other.test(n)&&(e[s]=e[1-s]==="right"?"left":"right")}),e}naming(t,e){return e==="both"||this.sideOf(t)===e?t:t.replace(this.each.other,n=>this.others[ns(n)][+(e==="right")])}pair(t,e,n){let s=[t,e].map(f=>this.trimmed(f.replace(this.each.throughout," ").replace(this.each.meanwhile," ")));if(s.some(f=>this.first.limb.test(f)))return null;let[r,a]=s.map(f=>this.reading(f));if(!(r.arms||a.arms)||!rl(r,a,n))return null;let[o,l]=r.arms&&!a.arms?[1,0]:[0,1],c=this.sides(s),h=r.arms&&a.arms,u=s.map((f,d)=>this.naming(f,c[d]));return{clause:{...this.measured(u[o]),meanwhile:Cm(u[l]),side:c[l]},certainty:Math.min(r.certainty,a.certainty),armsAlone:h,oneArmEach:h&&Dm(...c)}}reading(t){return this.read(this.measured(t).text)}sideOf(t){let e=t.replace(this.each.no_side," "),[n,s]=[this.first.left.test(e),this.first.right.test(e)];return n===s?"both":n?"left":"right"}goesRound(t){return this.first.round.test(t)&&!this.first.corner.test(t)}placeKept(t){let e=this.first.in_place.exec(t);if(!e||this.first.off.test(t))return null;let n=Hn(t.slice(0,e.index)),s=Hn(t.slice(e.index+e[0].length));if(/^[\u3040-\u30ff\u3400-\u9fff]/u.test(e[0]))return s?e:null;let r=!n&&s.split(/\s+/u).length<=2,a=!s||this.head.sign.test(s),o=this.first.sign.test(n)||this.first.joint.test(n);return r||a&&!o?e:null}saysOften(t){return this.first.many.test(t)}saysNumber(t){return this.first.often.test(t)||this.first.times.test(t)}turnsHead(t){return this.first.head_turns.test(t)}measured(t){let e=Um.exec(t);if(!e)return this.withMeasures(t);let n=this.withMeasures(Cm(t));if(Nm(n)||n.count>1)return n;let s=e[1]===void 0?n.seconds:(n.seconds??1.5)+Number(e[1]);return{...n,seconds:s,held:!0}}withMeasures(t){let e=_r(t),n=this.sideOf(t.replace(this.each.angle," "));for(let[o,[l,c,h]]of Object.entries(this.units)){let u=[...e.text.matchAll(this.each[o])].find(({groups:w})=>this.value(w.number)>=h);if(!u)continue;let{half:f,manner:d,noun:m}=u.groups;if(o==="steps"&&this.first.uncounted.test(d??""))continue;let _=(this.value(u.groups.number)+(f?.5:0))*c+(e[l]??0);if(!(_>0&&_<=this.most[l]))continue;let p=e.text.slice(0,u.index);if(this.first.larger.test(p))return e;let g=o==="steps"&&(!p.trim()||this.first.takes.test(p))?this.stepping(d??"",this.steps[ns(m)]):"",y=this.without(e.text,u,g);(y||o!=="steps")&&(e={...e,text:y,[l]:_})}let s=e.degrees===null&&n!=="both"&&this.first.angle.exec(e.text);s&&(e={...e,degrees:this.angles[ns(s[0])]});let r=this.first.corner.test(t)||this.first.round.test(t),a=this.first.about.test(e.text)&&!r&&this.counted(e).count===1;return e.degrees===null&&a&&(e={...e,degrees:180}),e.degrees!==null?{...e,degrees:(n==="right"?-1:1)*e.degrees}:e.metres===null&&e.seconds===null&&e.steps===null?this.counted(e):e}stepping(t,e){let n=e.lastIndexOf(" ");return`${e.slice(0,Math.max(n,0))} ${t}${e.slice(n+1)}`.trim()}counted(t){let e=this.first.often.exec(t.text),n;if(e)n=this.adverbs[ns(e[0])];else{if(e=this.first.times.exec(t.text)??this.first.bare.exec(t.text),!e)return t;n=Math.trunc(this.value(e.groups.number??e.groups.after))}if(!(n>1&&n<=this.maxCount))return t;let s=this.without(t.text,e);return s?{...t,text:s,count:n}:t}value(t){let e=this.numbers[ns(t)];if(e!==void 0||!/^[一二三四五六七八九两零十百]+$/u.test(t))return e??Number(t.replace(",","."));let n=0,s=0;for(let r of t.replaceAll("零",""))"十百".includes(r)?[n,s]=[n+(s||1)*(r==="十"?10:100),0]:s=r==="两"?2:"一二三四五六七八九".indexOf(r)+1;return n+s}without(t,e,n=""){return this.trimmed([t.slice(0,e.index).trimEnd(),...n?[n]:[],t.slice(e.index+e[0].length).trimStart()].join(" "))}trimmed(t){return Hn(Hn(t).replace(this.each.loose,""))}};var ol=class{constructor(t,e){this.tokenizer=e,this.keys=t.raw("text.encoder.keys",Int32Array),this.width=t.shape("text.encoder.rows.weight")[1];let n="text.encoder.rows.weight";this.stored=t.has(`${n}.int8_scale`),this.rows=this.stored?t.raw(n,Int8Array):t.floats(n),this.scales=this.stored?t.scales(n):null,this.weight=t.floats("text.text_proj.weight"),this.bias=t.floats("text.text_proj.bias"),this.places=t.has("text.places")?t.floats("text.places"):null,this.placeKeys=t.has("text.keys")?t.floats("text.keys"):this.places,this.remembered=new Map}encode(t){return this.read(t).place}read(t){let e=this.remembered.get(t);return e||(e=this.pool(this.mean(this.tokenizer.encode(t))),this.remembered.set(t,e)),e}mean(t){let e=new Float64Array(this.width);return t.forEach((n,s)=>{let r=n<32768?n:3,a=t[s+1]<32768?t[s+1]:3;r>=3&&this.addRow(r,e),s+1<t.length&&(r>=3||a>=3)&&this.addRow((r+1)*32768+a,e)}),e.map(n=>n/t.length)}addRow(t,e){let n=0,s=this.keys.length;for(;n<s;){let a=n+s>>1;this.keys[a]<t?n=a+1:s=a}if(this.keys[n]!==t)return;let r=this.stored?this.scales[n]:1;for(let a=0;a<this.width;a++)e[a]+=this.rows[n*this.width+a]*r}pool(t){let e=ll(Array.from(this.bias,(c,h)=>{let u=c;for(let f=0;f<this.width;f++)u+=this.weight[h*this.width+f]*t[f];return u}));if(!this.places)return{place:Float32Array.from(e),closeness:null};let n=e.length,s=[];for(let c=0;c<this.places.length;c+=n){let h=0;for(let u=0;u<n;u++)h+=this.placeKeys[c+u]*e[u];s.push(30*h)}let r=Math.max(...s),a=s.map(c=>Math.exp(c-r)),o=a.reduce((c,h)=>c+h,0),l=new Array(n).fill(0);return a.forEach((c,h)=>{for(let u=0;u<n;u++)l[u]+=c/o*this.places[h*n+u]}),{place:Float32Array.from(ll(l)),closeness:r/30}}};function ll(i){let t=Math.max(Math.hypot(...i),1e-12);return i.map(e=>e/t)}var lv=.65,cv=4,hv=.5,uv=3,fv=.5,dv=[["bye","wave"]],pv=/[\u3040-\u30ff\u3400-\u9fff]/u,mv=/[\u3400-\u9fff]/gu,gv=/[\u3040-\u30ff\u3400-\u9fff]+|(?:(?![\u3040-\u30ff\u3400-\u9fff])[\p{L}\p{N}_])+/gu;function Gu(i){let t=new Set;for(let[e]of i.normalize("NFKC").toLowerCase().replaceAll("ß","ss").matchAll(gv)){if(!pv.test(e)){t.add(e);continue}for(let n=0;n+1<e.length;n++)t.add(e.slice(n,n+2));for(let[n]of e.matchAll(mv))t.add(n)}return t}var cl=class{constructor(t,e,n){this.meta=t,this.tower=n,this.words=new Set(t.words),this.fillers=new Set(t.fillers??t.words),this.keyWords=new Map(Object.entries(t["key-words"]));let s=e.floats("means"),r=s.length/t.actions.length;this.means=t.actions.map((a,o)=>s.subarray(o*r,(o+1)*r)),this.checkedTexts=new Map}twins(t){return dv.find(e=>e.includes(t))??[t]}check(t){let e=this.checkedTexts.get(t);return e||(e=this.judged(t),this.checkedTexts.set(t,e)),e}judged(t){let{place:e,closeness:n}=this.tower.read(t),s=ll(Array.from(e)),r=this.means.map(p=>p.reduce((g,y,w)=>g+y*s[w],0)),{actions:a,weights:o,reliability:l={}}=this.meta,c=r.map((p,g)=>g).sort((p,g)=>r[g]-r[p]).filter(p=>a[p]),h=Gu(t),u=this.evidence(h,r,c),f=this.meta["warning-weights"],d=o?km(u,o):this.familiar(h)?1:-1;this.meta["min-cosine"]!=null&&Math.max(...r)>=this.meta["min-cosine"]&&(d=Math.max(d,1));let m=(f&&n!=null?km([n,...u],f):d)>0,_=c.slice(0,uv).map(p=>a[p]);return m&&_.length&&(l[_[0]]??1)<fv?{known:!1,nearest:_,unreliable:_[0],certainty:d}:{known:m,nearest:_,unreliable:null,certainty:d}}evidence(t,e,n){let{actions:s}=this.meta,[r,...a]=n,o=new Set,l=this.twins(s[r]),c=a.find(d=>!l.includes(s[d]))??r,h=0,u=!0;for(let d of t){let m=this.keyWords.get(d);if(m)m.forEach(_=>o.add(_));else for(let[_,p]of this.keyWords)zm(d,_)&&p.forEach(g=>o.add(g));this.words.has(d)&&h++,this.fillers.has(d)||(u=!1)}let f=o.size===0?0:[...o].some(d=>d===r||l.includes(s[d]))?1:-1;return[e[r],e[r]-e[c],h/Math.max(t.size,1),f,Number(u),1]}familiar(t){let e=[...t];if(e.some(r=>this.keyWords.has(r))||e.every(r=>this.words.has(r))&&!e.every(r=>this.fillers.has(r)))return!0;let n=e.filter(r=>!this.fillers.has(r)&&[...this.keyWords.keys()].some(a=>zm(r,a))),s=e.filter(r=>this.words.has(r)||n.includes(r));return n.length>0&&s.length>=hv*e.length}warning(t){let{known:e,nearest:n,unreliable:s}=this.check(t);if(e)return null;if(s){let r=Math.round(100*this.meta.reliability[s]);return`“${t}” asks for “${s}”, which this model shows in about ${r}% of tries; look at the motion before you use it.`}return`“${t}” is far from anything this model was trained on; nearest known actions: ${n.join(", ")}.`}};function km(i,t){return i.reduce((e,n,s)=>e+n*t[s],0)}function zm(i,t){let[e,n]=[[...i],[...t]],s=Math.max(cv,Math.ceil(lv*Math.max(e.length,n.length)));return Math.min(e.length,n.length)>=s&&e.slice(0,s).join("")===n.slice(0,s).join("")}var _v=[...wa,"side-step"],yv=.0049,Vu=90,xv=2.3,vv=2.2,Mv=20*Math.PI/180,Gm=8,bv=.2,wv=75,is=.5,Vm=120,Sv=3,hl=[2.5,3],Ev=2,ul="claps three times",Av=4,Tv=.15,Rv=.43,Cv=6,Hm=1,Pv=.5,Wm=10,Xm=i=>i.split(/\s+/u).filter(Boolean).length,fl=class{constructor(t,e,n){Object.assign(this,{sampler:t,scope:e,settings:n,bent:new Map}),this.reader=new yr(n.measures,s=>this.reading(s))}reading(t){if(!t)return{action:null,certainty:-1/0,arms:!1};let{nearest:[e],certainty:n}=this.scope.check(t);return{action:this.scope.twins(e)[0],certainty:n,arms:this.scope.meta.arms.includes(e)}}warning(t){let e=this.reader.clauses(t),n=e.flatMap(({text:r,meanwhile:a})=>[r,a]).filter(Boolean),s=n.length===1?[this.scope.warning(this.reader.whole(t,e))]:[];return(n.length>1||!(al(e[0])||s[0]===null))&&(s=n.map(r=>this.scope.warning(r))),n.map((r,a)=>this.unlearned(r)??s[a]).find(Boolean)??null}unlearned(t){let e=[!1,!0].map(f=>zu(t,f)),{actions:n}=this.scope.meta,s=new Set(n),r=n.map(f=>zu(f,!1)),a=f=>this.settings.ownWords&&[...Gu(f)].every(d=>this.scope.words.has(d)),o=this.settings.unlearned.filter(([f,d,m])=>e[Number(m)].includes(d)&&!f.some(_=>s.has(_))&&!r.some(_=>_.includes(d))&&!a(d)).map(([,f,d])=>[Xm(e[Number(d)].slice(0,e[Number(d)].indexOf(f))),f]),l=f=>`“${t}” asks ${f}, which this model has not learned.`;if(this.reader.turnsHead(t))return l("the head alone to turn");if(!o.length)return null;let[c,h]=o.reduce((f,d)=>d[0]<f[0]||d[0]===f[0]&&d[1].length>f[1].length?d:f);if(!h.startsWith(" "))return l(`for “${h}”`);let u=[...Di(t).matchAll(ku)].map(f=>[f.index,f.index+f[0].length]);return l(`for “${Di(t).slice(u[c][0],u[c+Xm(h)-1][1]).replace(/ (?:a|the)$/,"")}”`)}async make(t,e,n){let s={told:n};return t.clip?this.edited(t,e,s):t.path?this.alongPath(t,e,s):t.blocks.length===1?this.sentence(t.blocks[0].text,t.blocks[0].seconds,e,s):this.timeline(t.blocks,e,s)}async timeline(t,e,n){let s=[],r=[];for(let{text:a,frames:o}of this.passages(t)){let l=this.reader.clauses(a),c=u=>Yt(o*u/l.length),h=l.length*bv;if(l.length>1&&o<h*Et)throw new Error(`“${a}” asks for ${l.length} things in ${(o/Et).toFixed(1)} seconds; give it ${h.toFixed(1)} or more.`);for(let[u,f]of l.entries())r.push(await this.stretch(f,o/Et,e,c(u+1)-c(u)));s.push(...l)}return this.performed(s,r,t.map(({text:a})=>a).join(", then "),e,n)}passages(t){let e=0,n=0;return t.map(({text:s,seconds:r})=>{e+=r;let a=Yt(e*Et)-n;return n+=a,{text:s,frames:a,afresh:this.beginsStanding(s)}})}beginsStanding(t){return this.scope.meta.gestures.includes(this.nearest(t))}async sentence(t,e,n,s){let r=this.reader.clauses(t),a=Yt(e*Et);if(a<Gm)throw new Error(`${e} seconds are too short; ask for ${(Gm/Et).toFixed(2)} or more.`);let o=this.settings.maxSeconds,l=o!==null&&a>Yt(o*Et);if(r.length>1||!al(r[0])||l||this.applauds(r[0])||await this.turns(r[0]))return this.clausesOf(t,r,e,n,s);let c=this.reader.whole(t,r),h=this.nearest(c),u=null,f=null;for(let d of Cu(n)){let m=(u===null?1:Sv)*this.settings.guidance,_=await this.sampler.sample(c,a,d,null,m);fu(_,this.steady(c));let p=this.rested(dr(_,this.settings.post,{text:t}),[c]);s.told?.(a);let g=this.does(c,p);if((u===null||g)&&(u=p),f=g||!this.scope.meta.checked.includes(h)?null:`“${t}”, read as “${h}”: none of ${Tu} samples shows that, by how joints move; try another seed or other words.`,g)break}return{...u,missed:f}}async clausesOf(t,e,n,s,r){let a=[];for(let o of e){let l=e.length>1&&this.isSingle(o);a.push(await this.stretch(o,l?Math.min(n,hl[1]):n,s))}return this.performed(e,a,t,s,r)}async performed(t,e,n,s,r){let a=e.map(({passage:_})=>_),o=e.some(({given:_})=>_),l=ti(a.reduce((_,{frames:p})=>_+p,0)),c=[],h=0;for(let _ of e){if(c.push(h),_.given&&(l.values.set(_.given.values,h*It),l.known.set(_.given.known,h*It),h&&t[c.length-1].metres===0))for(let p=h;p<h+Yt(is*Et);p++)l.known[p*It+ue+Sn]=l.known[p*It+ue+Nn]=0;h+=_.passage.frames}let u=await this.ledDown(l,t,c,s);t[0].held&&l.known.fill(1,0,a[0].frames*It);let f=await vi(this.sampler,a,s,{...r,constraint:o||u?l:null,window:this.window(),overlap:t.some(({count:_})=>_>1)?Wm:Ns});for(let[_,p]of t.entries())if(p.meanwhile){let g=Pu([p.side==="both"?"arms":`${p.side}-arm`]),y=Iu(f,c[_],c[_]+a[_].frames,g);f=await il(this.sampler,p.meanwhile,y,s)}for(let[_,p]of t.entries())p.degrees===null&&p.metres===null&&fu(f,this.steady(p.text,t.length===1),c[_],c[_]+a[_].frames);let d=dr(f,this.settings.post,{text:n}),m=this.rested(d,[t[0].text,t.at(-1).text],t.at(-1).held);for(let[_,{count:p,text:g}]of t.entries())if(p>1&&this.byArms(g)&&!(this.nearest(g)in jo)){let{frames:y}=a[_],w=Array.from({length:p-1},(b,E)=>Math.floor(y*(E+1)/p));m=wu(m,w.map(b=>c[_]+b))}return{...m,text:n}}async ledDown(t,e,n,s){let r=({text:o})=>gr.includes(this.nearest(o)),a=!1;for(let o=1;o<e.length;o++){let l=e.slice(o-1,o+1),c=[];if(!l.some(r))continue;for(let{text:d}of l)c.push((await mr(this.sampler,d,s)).height);let h=c[1]-c[0],u=Math.max(n[o]-Cv,1),f=Math.min(Yt(Math.abs(h)/Rv*Et),Me(t.values)-u);if(!(Math.abs(h)<Tv)){for(let d=0;d<f;d++){let m=f>1?d/(f-1):0,_=(u+d)*It+ue+_a;t.known[_]||(t.values[_]=c[0]+h*m**3*(10-15*m+6*m*m)),t.known[_]=1}a=!0}}return a}window(){return Math.min(nl,Math.max(2*Ns,Yt((this.settings.maxSeconds??nl/Et)*Et)))}async stretch(t,e,n,s=null){s!==null&&(t={...t,seconds:s/Et});let{text:r,count:a}=t,o=this.beginsStanding(r);t.steps!==null&&t.seconds===null&&(t={...t,seconds:await this.stepping(t,n)}),e=t.seconds??e;let l=h=>({passage:{text:r,frames:Me(h.values),afresh:o},given:h});if(this.applauds(t)&&!await this.turns(t)){let h=Math.max(1,Yt(e/Ev)),u=Math.max(1,Yt(e*Et));if(h>1)return this.repeated({...t,count:h},ul,e,u);if(!t.held)return{passage:{text:ul,frames:u,afresh:this.beginsStanding(ul),miss:this.miss(t,u)}}}if(await this.turns(t))return l(await this.turn(t,e,n));if(t.metres===0){let h=ti(Math.max(1,Yt(e*Et)));for(let u=ue;u<h.values.length;u+=It)h.known[u+Sn]=h.known[u+Nn]=1;return l(h)}if(t.metres!==null){let h=await mr(this.sampler,r,n),u=t.seconds===null?null:Math.max(t.seconds*Et-1,1)/Et,f=m=>Lu([[0,0],[0,t.metres]],{...h,seconds:m}),d;try{d=f(u)}catch(m){if(s!==null)throw m;d=f(null)}return l(Ou(Du(d,await this.sway(r,d.points.length,n))))}if(a>1)return this.repeated(t,r,e,s);let c=Math.max(1,Yt(e*Et));return t.held?l(await this.held(t,c,n)):{passage:{text:r,frames:c,afresh:o,miss:this.miss(t,c)}}}isSingle({text:t,held:e}){let n=this.nearest(t);return n in jo&&n!=="clap"&&!e&&!this.reader.saysOften(t)}applauds({text:t,count:e,metres:n}){if(this.nearest(t)!=="clap"||e>1||n!==null)return!1;let s=this.reading(ul);return s.action==="clap"&&s.certainty>0&&!this.reader.saysNumber(t)}repeated(t,e,n,s){let{count:r}=t,a=s!==null?Math.ceil(s/r):Yt(Math.min(Math.max(n/r,hl[0]),hl[1])*Et),o=s??a*r;return{passage:{text:e,frames:o,afresh:this.beginsStanding(e),window:a+Wm,miss:this.miss(t,o)}}}async turns({degrees:t,metres:e,count:n,text:s}){return t!==null||this.nearest(s)==="spin"?!0:this.nearest(s)==="turn"&&this.reader.sideOf(s)!=="both"?!this.reader.turnsHead(s):e===null&&n===1&&await this.bend(s)!==0}async stepping({steps:t,text:e},n){if(!_v.includes(this.nearest(e)))return null;let{speed:s}=await mr(this.sampler,e,n);return t*Math.sqrt(60*yv/s)}async bend(t){let e=this.reader.sideOf(t),n=this.reader.goesRound(t);if(!wa.includes(this.nearest(t))||!(n||e!=="both"))return 0;if(!this.bent.has(t)){let{turning:s}=await mr(this.sampler,t,0),r=e==="both"?s>0:e==="left",a=n?360:Math.abs(s)<Mv?0:Vu;this.bent.set(t,r?a:-a)}return this.bent.get(t)}async turn({degrees:t,text:e,count:n,seconds:s},r,a){let o=this.nearest(e)==="turn",l=this.reader.sideOf(e);if(t!==null){let d=Sa(t,s??void 0);return o?qm(d):d}if(o&&l!=="both"){let d=Vu*n*(l==="left"?1:-1);return qm(n>1?Sa(d,s??void 0):Sa(d,r,Math.max((r-vv)/2,is)))}let c=await this.bend(e);if(c&&s===null&&(r=Math.max(r,Math.abs(c)/Vm+2*is)),c){let d=Math.abs(c)===Vu?Sa(c,r,Math.max((r-xv)/2,is)):Iv(c,r);for(let[m,_]of(await this.sway(e,Me(d.values),a)).entries())d.values[m*It+ue+Xe]+=_;return d}let h=360/Vm,u=n;u<=1?u=Math.max(Yt((r-2*is)/h),1):s===null&&(r=u*h+2*is);let f=l==="both"?BigInt(a)%2n===0n:l==="left";return Sa(360*(f?u:-u),r)}async held(t,e,n){let{text:s}=t,r=Math.min(e,Yt(Av*Et)),a={text:s,frames:r,afresh:this.beginsStanding(s),miss:this.miss(t,r)};return xm(await vi(this.sampler,[a],n),e)}async sway(t,e,n){return Nu(await vi(this.sampler,[{text:t,frames:e}],n))}nearest(t){return t?this.scope.check(t).nearest[0]??null:null}byArms(t){return this.scope.meta.arms.includes(this.nearest(t))}steady(t,e=!0){return e&&this.scope.meta.still?.includes(this.nearest(t))?[Sn,Nn,Xe]:this.byArms(t)?[Xe]:[]}rested(t,e,n=!1){return e.some(s=>this.scope.meta.gestures.includes(this.nearest(s)))?wu(t,null,n):t}wanted(t){let e=this.nearest(t),{checked:n,arms:s}=this.scope.meta;if(e===null)return null;let r=em(e,this.reader.sideOf(t),s.includes(e)),a=[...n.includes(e)?[tm[e]]:[],...r?[r]:[]];return a.length?o=>a.every(l=>l(o)):null}does(t,e){let n=this.wanted(t);return n===null||e.frames/Et<Hm||n(Ko(e))}miss(t,e){let n=this.wanted(t.text),s=this.nearest(t.text),r=this.reader.sideOf(t.text);if(s===null||e<Hm*Et)return null;let a=this.scope.meta.gestures.includes(s),o=this.window();return n===null&&!a?null:l=>{let c=Qi(l),h=Ko(c),u=Me(l),f=t.count>1||e<=hl[1]*Et&&this.isSingle(t)?nm(s,h,r):null,d=+(n!==null&&!n(h));return d&&u>o&&(d=+!n(Ko(dr(je(l,u-o,u),this.settings.post,{})))),f!==null&&(d=Math.abs(f-Yt(t.count*u/e))),d+Pv*Number(a&&u>=e&&!Jo(c))}}unseen(t){let[{text:e},...n]=this.reader.clauses(t);return n.length?null:this.miss(_r(e),1/0)}async alongPath({blocks:t,path:e},n,s){let r=t.length===1,a=this.passages(t),o=await mr(this.sampler,t[0].text,n),l=a.reduce((d,{frames:m})=>d+m,0),c=Lu(e,{...o,seconds:r?t[0].seconds:(l-1)/Et});a[a.length-1].frames+=c.points.length-l;let h=Nu(await vi(this.sampler,a,n,{...s,told:void 0})),u=Ou(Du(c,h)),f=await vi(this.sampler,a,n,{...s,constraint:u});return dr(f,this.settings.post,{known:u.known,text:a.map(({text:d})=>d).join(", then "),place:{x:c.points[0][0],z:c.points[0][1],heading:c.headings[0]},carried:!0})}async edited({blocks:t,clip:e},n,s){let r=t.map(p=>p.text).join(", then "),{motion:a,mode:o}=e,l=t.reduce((p,g)=>p+g.seconds,0),c=Yt(e.keep*Et),h;if(o==="redo"){let p=Yt(e.from*Et),g=Math.min(Yt(e.until*Et),a.frames);if(!(p>=0&&p<g))throw new Error(`The clip lasts ${(a.frames/Et).toFixed(2)} seconds; choose a span of it.`);h=_m(a,p,g,e.joints.length?Pu(e.joints):null)}else{let p=o==="between"?2:1,g=Yt(l*Et)+p*c;if(a.frames<c)throw new Error(`The clip lasts ${(a.frames/Et).toFixed(2)} seconds, less than the ${e.keep} to be kept.`);let y=o==="between"?a:$m(a,a.frames-c,a.frames);h=ym(y,o==="between"?e.second??a:null,c,g,o==="between"&&!e.second)}let u=r?{miss:this.unseen(r)}:{guidance:0},f=r&&this.reader.whole(r,this.reader.clauses(r)),{features:d,known:m}=await vm(this.sampler,f||gm,h,n,{...s,...u}),_=dr(d,this.settings.post,{known:m,text:r,place:h.place});return{..._,missed:r?this.unlessShown(r,_,h.constraint.known):null}}unlessShown(t,e,n){let s=[...Array(e.frames).keys()].filter(o=>je(n,o,o+1).includes(0)),[{text:r},...a]=this.reader.clauses(t);return!s.length||a.length||this.does(r,$m(e,s[0],s.at(-1)+1))?null:`“${t}”: what was made anew does not show “${this.nearest(r)}”, by how joints move; look at it, try a longer span, another seed, or a clip that stands.`}},$m=(i,t,e)=>({...i,frames:e-t,quaternions:i.quaternions.slice(t*88,e*88),root:i.root.slice(t*3,e*3),contacts:i.contacts.slice(t*2,e*2)});function qm(i){let t=0;for(;!i.values[t*It+ue+Xe];)t++;for(;t<Me(i.values);t++)for(let e of[Sn,Nn])i.values[t*It+ue+e]=0,i.known[t*It+ue+e]=1;return i}function Iv(i,t){let e=ti(Yt(t*Et));for(let n=0;n<Me(e.values);n++)e.values[n*It+ue+Xe]=i*Math.PI/180/t,e.known[n*It+ue+Xe]=1;return e}function Sa(i,t=Math.max(Math.abs(i)/wv,1)+2*is,e=is){let n=Yt(Math.min(e,t/4)*Et),s=Math.max(Yt(t*Et)-2*n,1),r=ti(s+2*n),a=o=>i*Math.PI/180*(3*(o/s)**2-2*(o/s)**3);for(let o=0;o<s+2*n;o++){let l=o-n,c=o*It+ue+Xe;l>=0&&l<s&&(r.values[c]=(a(l+1)-a(l))*Et),r.known[c]=1}return r}var dl=class{constructor(t,e,n){Object.assign(this,{denoiser:t,tower:e,settings:n})}async sample(t,e,n,s=null,r=this.settings.guidance){let{mean:a,std:o,schedule:l,nullText:c,tags:h}=this.settings,u=e*It,f=mm(n,t,u),d=new Uint8Array(u),m=s?s.shown.map((E,T)=>E&&s.known[T]):d,_=new Float32Array(u);if(s)for(let E=0;E<u;E++)s.known[E]&&(_[E]=(s.values[E]-a[E%It])/o[E%It]);let p=this.tower.encode(t),g=this.opened(p),y=f.slice(),w=null;for(let E=0;E<l.length;E++){let[T,x]=l[E],A=E+1<l.length?l[E+1][1]:1,F=Math.sqrt(x),L=Math.sqrt(1-x),O=y;if(s){O=y.slice();for(let W=0;W<u;W++)s.known[W]&&(O[W]=m[W]?_[W]:F*_[W]+L*f[W])}let H=await this.guided(O,T,p,c,h,m,r,g),Z=this.cleaned(y,H,F,L,s?.known,_),P={clean:Z,lambda:Math.log(F/L)};y=Nv(y,this.settings.sampler==="ddim"?Z:Lv(P,w,A),F,L,A),w=P}let b=new Float32Array(u);for(let E=0;E<u;E++)b[E]=s?.known[E]?s.values[E]:y[E]*o[E%It]+a[E%It];return b}opened(t){let{adapters:e}=this.settings;if(!e)return 0;let{places:n,adapterOf:s}=e,r=t.length,a=0,o=-1/0;for(let l=0;l<s.length;l++){let c=0;for(let h=0;h<r;h++)c+=n[l*r+h]*t[h];c>o&&([a,o]=[l,c])}return Number(s[a])}async guided(t,e,n,s,r,a,o,l){if(o===1||o===0)return(await this.denoiser.predict([t],e,[o?n:s],r,a,l))[0];let[c,h]=await this.denoiser.predict([t,t],e,[n,s],r,a,l);return c.map((u,f)=>h[f]+o*(u-h[f]))}cleaned(t,e,n,s,r,a){let{clip:o,prediction:l}=this.settings;return t.map((c,h)=>{let u=e[h];return r?.[h]?u=a[h]:l==="epsilon"?u=(c-s*e[h])/n:l==="v"&&(u=n*c-s*e[h]),o===null?u:Math.min(Math.max(u,-o),o)})}};function Lv({clean:i,lambda:t},e,n){if(!e||n===1)return i;let s=.5*(.5*Math.log(n/(1-n))-t)/(t-e.lambda);return i.map((r,a)=>r+s*(r-e.clean[a]))}function Nv(i,t,e,n,s){let r=Math.sqrt(1-s),a=Math.sqrt(s);return i.map((o,l)=>a*t[l]+r*(o-e*t[l])/n)}var pl=class{constructor(t,e){this.maxTokens=e,this.pieces=new Map,this.bytes=[],this.longest=1;let n=0,s=0,r=new Uint8Array;for(let[a,o]of Hu(t)){if(a===3&&(r=o),a!==1)continue;let l="",c=0,h=1;for(let[u,f]of Hu(o))u===1&&(l=new TextDecoder().decode(f)),u===2&&(c=f),u===3&&(h=f);h===6&&(this.bytes[parseInt(l.slice(3,5),16)]=s),(h===1||h===4||h===5)&&(this.pieces.set(l,{id:s,score:c}),this.longest=Math.max(this.longest,[...l].length),n=Math.min(n,c)),s++}this.unknown=Math.fround(n-10);for(let[a,o]of Hu(r))if(a===2){let l=new DataView(o.buffer,o.byteOffset).getUint32(0,!0);this.trie=new Uint32Array(o.slice(4,4+l).buffer),this.replacements=o.subarray(4+l)}}encode(t){let e=[0,...this.best([...this.normalized(t)]),2];return e.length>this.maxTokens?[...e.slice(0,this.maxTokens-1),2]:e}normalized(t){let e=new TextEncoder().encode(t),n=[];for(let r=0;r<e.length;){let a=0,o=-1;if(this.trie){let l=Ym(this.trie[0]);for(let c=r;c<e.length;c++){l^=e[c];let h=this.trie[l];if(h===void 0||(h&2147483903)>>>0!==e[c])break;l^=Ym(h),h>>>8&1&&(a=c+1-r,o=this.trie[l]&2147483647)}}if(a===0)a=e[r]<128?1:e[r]<224?2:e[r]<240?3:4,n.push(...e.subarray(r,r+a));else for(let l=o;this.replacements[l];l++)n.push(this.replacements[l]);r+=a}return new TextDecoder().decode(Uint8Array.from(n)).split(" ").filter(Boolean).map(r=>"▁"+r).join("")}best(t){let e=[0],n=[0],s=[[]],r=(o,l,c,h)=>{let u=Math.fround(e[o]+c);(e[l]===void 0||u>e[l])&&(e[l]=u,n[l]=o,s[l]=h)};for(let o=0;o<t.length;o++){let l=!1;for(let c=1,h="";c<=this.longest&&o+c<=t.length;c++){h+=t[o+c-1];let u=this.pieces.get(h);u&&(r(o,o+c,u.score,[u.id]),l||=c===1)}if(!l){let c=[...new TextEncoder().encode(t[o])];r(o,o+1,this.unknown,c.map(h=>this.bytes[h]??3))}}let a=[];for(let o=t.length;o>0;o=n[o])a.unshift(s[o]);return a.flat()}},Ym=i=>i>>>10<<((i&512)>>>6);function*Hu(i){let t=new DataView(i.buffer,i.byteOffset,i.byteLength),e=0,n=()=>{let s=0,r=1,a;do a=i[e++],s+=(a&127)*r,r*=128;while(a&128);return s};for(;e<i.length;){let s=n(),r=s&7;if(r===0)yield[s>>>3,n()];else if(r===5)yield[s>>>3,t.getFloat32(e,!0)],e+=4;else if(r===1)yield[s>>>3,t.getFloat64(e,!0)],e+=8;else{let a=n();yield[s>>>3,i.subarray(e,e+a)],e+=a}}}var ml=class i{static async open(t,e){Ho(t.skeleton);let n=new Rs(e.weights),s=new ol(n,new pl(e.tokenizer,t.maxTokens)),r=new ar(e,t.weights),a={...t,mean:n.floats("statistics.mean"),std:n.floats("statistics.std"),nullText:n.floats("denoiser.null_pooled"),adapters:t.adapters&&{places:n.floats("denoiser.places"),adapterOf:n.raw("denoiser.adapter_of",BigInt64Array)}},o=new cl(t.scope,new Rs(e.scope),s);return new i(new fl(new dl(r,s,a),o,a))}constructor(t){this.director=t}make({scene:t,seed:e},n){return this.director.make(t,e,n)}warning({text:t}){return this.director.warning(t)}};function Zm(i){let t=Wu();i.onmessage=async({data:e})=>{let{id:n,call:s,...r}=e;try{let a=await t(s,r,o=>i.postMessage({id:n,progress:o}));i.postMessage({id:n,result:a})}catch(a){i.postMessage({id:n,error:String(a?.message??a)})}}}function Wu(){let i=null;return async(t,e,n)=>t==="prepare"?(Dv(e),null):t==="open"?(i=await ml.open(e.settings,e.parts),null):t==="help"?(Ov(e),null):t==="helper"?(i.director.sampler.denoiser.helper=Uv(e.port),null):i[t](e,n)}function Dv({settings:i,texts:t}){let e=new yr(i.measures,()=>({action:null,certainty:-1/0,arms:!1}));for(let n of[...t,...t])e.clauses(n)}function Ov({parts:i,names:t,port:e}){let n=new ar(i,t);n.session(i.adapted?"adapted":"graph").catch(()=>null),e.onmessage=async({data:{id:s,args:r}})=>{try{e.postMessage({id:s,result:await n.predict(...r)})}catch(a){e.postMessage({id:s,error:String(a)})}}}function Uv(i){let t=new Map,e=0;return i.onmessage=({data:{id:n,result:s,error:r}})=>{let{resolve:a,reject:o}=t.get(n);t.delete(n),r?o(new Error(r)):a(s)},(...n)=>new Promise((s,r)=>{t.set(++e,{resolve:s,reject:r}),i.postMessage({id:e,args:n})})}var Fv=180/Math.PI;function Jm(i){let{parents:t,names:e,offsets:n}=Ee,s=Bv(),r=c=>(Math.round(c*1e5)/1e5+0).toFixed(5).replace(/^-0\.00000$/,"0.00000"),a=["HIERARCHY"],o=(c,h)=>{let u="	".repeat(h),f=c?n[c].map(m=>m*100):[0,0,0];a.push(`${u}${c?"JOINT":"ROOT"} ${e[c]}`,`${u}{`,`${u}	OFFSET ${f.map(r).join(" ")}`),a.push(`${u}	CHANNELS ${c?"3":"6 Xposition Yposition Zposition"} Zrotation Xrotation Yrotation`);let d=s.filter(m=>t[m]===c);for(let m of d)o(m,h+1);for(let[m,_]of Ee.tips)m===c&&a.push(`${u}	End Site`,`${u}	{`,`${u}		OFFSET ${_.map(p=>r(p*100)).join(" ")}`,`${u}	}`);a.push(`${u}}`)};o(0,0),a.push("MOTION",`Frames: ${i.frames}`,`Frame Time: ${(1/i.fps).toFixed(8)}`);let l=Array.from({length:qt},()=>[0,0,0]);for(let c=0;c<i.frames;c++){let h=l.map((f,d)=>kv(Ke(i.quaternions,(c*qt+d)*4),f,c===0));l=h;let u=[0,1,2].map(f=>i.root[c*3+f]*100);for(let f of s)u.push(...h[f].map(d=>d*Fv));a.push(u.map(f=>f.toFixed(5)).join(" "))}return`${a.join(`
`)}
`}function Bv(){let i=[],t=[0];for(;t.length;){let e=t.pop();i.push(e);for(let n=qt-1;n>0;n--)Ee.parents[n]===e&&t.push(n)}return i}function kv(i,t,e){let n=Math.hypot(i[1],i[4]),s=n<1e-8,r=s?t[0]:Math.atan2(-i[1],i[4]),a=Math.atan2(i[7],n),o=(u,f)=>[u,f,Math.atan2(Math.cos(u)*i[2]+Math.sin(u)*i[5],Math.cos(u)*i[0]+Math.sin(u)*i[3])].map((d,m)=>d-2*Math.PI*Math.round((d-t[m])/(2*Math.PI))),l=o(r,a),c=o(r+Math.PI,Math.PI-a),h=u=>u.reduce((f,d,m)=>f+Math.abs(d-t[m]),0);return!e&&!s&&h(c)<h(l)?c:l}var Km=1313821514,jm=5130562;function Xu(i){let t=new DataView(i.buffer,i.byteOffset,i.byteLength);if(i.length<20||t.getUint32(0,!0)!==1179937895)throw new Error("This is no GLB file.");let e={document:null,data:new Uint8Array};for(let n=12;n+8<=i.length;){let s=t.getUint32(n,!0),r=t.getUint32(n+4,!0),a=i.subarray(n+8,n+8+s);r===Km&&(e.document=JSON.parse(new TextDecoder().decode(a))),r===jm&&(e.data=a),n+=8+s}if(!e.document)throw new Error("This is no whole GLB file.");return e}function Qm(i,t){let{document:e,data:n}=Xu(t),{frames:s,fps:r}=i,[a]=e.animations,o=new Map,l=(d,m)=>o.set(d,m);for(let{sampler:d,target:m}of a.channels){let{input:_,output:p}=a.samplers[d];if(l(_,Float32Array.from({length:s},(y,w)=>w/r)),m.path==="translation"){l(p,i.root.slice());continue}let g=new Float32Array(s*4);for(let y=0;y<s;y++)g.set(i.quaternions.subarray((y*qt+m.node)*4,(y*qt+m.node)*4+4),y*4);Gn(g,4);for(let y=0;y<g.length;y+=4)g.copyWithin(y,y,y+4),g.set([g[y+1],g[y+2],g[y+3],g[y]],y);l(p,g)}let c=[],h=0;e.bufferViews.forEach((d,m)=>{let _=e.accessors.findIndex(({bufferView:y})=>y===m),p=o.get(_),g=p?new Uint8Array(p.buffer):n.subarray(d.byteOffset,d.byteOffset+d.byteLength);h+=-h&3,Object.assign(d,{byteOffset:h,byteLength:g.length}),c.push([h,g]),h+=g.length,p&&Object.assign(e.accessors[_],{count:s}),p&&e.accessors[_].max&&Object.assign(e.accessors[_],{min:[0],max:[p[s-1]]})});let u=i.text||"motion";Object.assign(e.scenes[0],{name:u,extras:{text:i.text}}),a.name=u;let f=new Uint8Array(h);for(let[d,m]of c)f.set(m,d);return e.buffers[0].byteLength=h,zv(new TextEncoder().encode(JSON.stringify(e)),f)}function zv(i,t){let e=[i.length+(-i.length&3),t.length+(-t.length&3)],n=new Uint8Array(28+e[0]+e[1]).fill(32,20,20+e[0]),s=new DataView(n.buffer);return[1179937895,2,n.length,e[0],Km].forEach((r,a)=>s.setUint32(a*4,r,!0)),n.set(i,20),s.setUint32(20+e[0],e[1],!0),s.setUint32(24+e[0],jm,!0),n.set(t,28+e[0]),n}var Ea=[1,0,0,0,1,0,0,0,1],sg=.7,tg=[.45,.8],Gv=200,Vv=18e3,Hv=.01,Wv=.001,Xv=2e-5,$v=1e-4,qv=.15,Yv=1.2,Zv={spine1:"spine2",neck:"head",l_collar:"l_shoulder",r_collar:"r_shoulder",l_shoulder:"l_elbow",r_shoulder:"r_elbow",l_elbow:"l_wrist",r_elbow:"r_wrist",l_hip:"l_knee",r_hip:"r_knee",l_knee:"l_ankle",r_knee:"r_ankle",l_ankle:"l_foot",r_ankle:"r_foot"},eg={l_wrist:"l_elbow",r_wrist:"r_elbow"},Jv={l_foot:.02,r_foot:.02,l_knee:.04,r_knee:.04,pelvis:.08,spine3:.1,head:.08,l_elbow:.03,r_elbow:.03,l_wrist:.02,r_wrist:.02},ng=["spine1","spine2","spine3","neck","l_collar","r_collar","l_foot","r_foot"];function Zu(i,t){let{joints:e,axes:n}=Kv(i.names,t),s=Math.max(1,Math.round(i.fps/Et));if(s>1&&Math.abs(i.fps/s-Et)<Hv*Et&&(i=iM(i,s)),i.frames/i.fps*Et>Vv)throw new Error("The clip is longer than ten minutes; split it.");if(i.frames<2)throw new Error("The clip has one frame only.");let r=eM(i,e);if(!r&&!Object.keys(n).length)throw new Error("Its rest pose is no standing body. Bring it onto our skeleton first: motion-tools convert CLIP a.npz, then a.npz a.bvh.");let a=tM(i,e),o=jv(i,e);if(!(o>1e-6))throw new Error("Its legs have no length.");let l=a?Ea:rM(i.up??sM(i,e,r)),c=a?jt(Ee.offsets[Se.l_knee])/jt(i.offsets[e.l_knee]):lr/o,h=aM(i,e,nM(i,e,n,r),l,c);if(![...h.quaternions,...h.root].every(Number.isFinite))throw new Error("It holds numbers that are none.");return!a&&Qv(i,e,o)&&lg(h).forEach((u,f)=>{h.root[f*3+1]-=u}),a||(h=oM(h)),cM(lM(h),!a)}var $u=i=>i.replace(/^.*[:|]/,"").replace(/^mixamorig\d*/i,"").replace(/[^\p{L}\p{N}]/gu,"").toLowerCase();function Kv(i,t){let e=new Map,n=new Map;for(let u of i){let f=/^[^ _.\-]+[ _.\-]/.exec(u)?.[0];f&&n.set(f,(n.get(f)??0)+1)}let[s,r]=[...n].sort((u,f)=>f[1]-u[1])[0]??["",0];i.forEach((u,f)=>{let d=m=>{e.has(m)||e.set(m,f)};d($u(u)),r>=.8*i.length&&u.startsWith(s)&&d($u(u.slice(s.length)))});let a=t.map(u=>{let f={},d={};for(let[m,_]of Object.entries(u.joints)){let p=i.indexOf(_),g=p>=0?p:e.get($u(_));g!==void 0&&(f[m]=g,u.axes[_]&&(d[m]=u.axes[_]))}return{joints:f,axes:d,whole:Object.keys(f).length===Object.keys(u.joints).length,size:Object.keys(u.joints).length}}),o=a.find(u=>u.whole);if(o)return o;let l=({joints:u})=>Ee.names.filter(f=>!ng.includes(f)&&f in u).length,c=Ee.names.length-ng.length,[h]=[...a].sort((u,f)=>l(f)-l(u)||Object.keys(f.joints).length-Object.keys(u.joints).length||u.size-f.size);if(l(h)<c)throw new Error("Its joints have names the studio does not know. Bring it onto our skeleton first: motion-tools convert CLIP a.npz, then a.npz a.bvh.");return h}function rg(i,t,e){let n=[];for(;e!==t&&e>=0;)n.push(e),e=i.parents[e];return e===t?n:[]}var qu=(i,t,e)=>rg(i,t,e).reduce((n,s)=>Pe(n,i.offsets[s]),[0,0,0]);function jv(i,t){let e=["l","r"].map(n=>jt(qu(i,t[`${n}_hip`],t[`${n}_knee`]))+jt(qu(i,t[`${n}_knee`],t[`${n}_ankle`])));return(e[0]+e[1])/2}function Qv(i,t,e){return rg(i,t.pelvis,t.head).reduce((s,r)=>s+jt(i.offsets[r]),0)>Yv*e}function tM(i,t){if(Object.keys(t).length<qt)return!1;let e=jt(Ee.offsets[Se.l_knee])/Math.max(jt(i.offsets[t.l_knee]),1e-12);return Ee.names.every((n,s)=>s===0||i.parents[t[n]]===t[Ee.names[Ee.parents[s]]]&&i.offsets[t[n]].every((r,a)=>Math.abs(r*e-Ee.offsets[s][a])<$v))}function eM(i,t){let e=[];i.parents.forEach((l,c)=>e.push(l<0?i.offsets[c]:Pe(e[l],i.offsets[c])));let n=l=>e[t[l]],s=Pe(Ne(n("l_hip"),n("r_hip")),Ne(n("l_shoulder"),n("r_shoulder"))),r=[Ne(n("head"),n("pelvis"))];for(let l of"lr")r.push(Ne(n(`${l}_hip`),n(`${l}_knee`)),Ne(n(`${l}_knee`),n(`${l}_ankle`)));if([s,...r].some(l=>jt(l)<1e-9))return null;let a=r.reduce((l,c)=>Pe(l,De(Ze(c),1/r.length)),[0,0,0]),o=[];for(let l of[Ze(s),a]){let c=l.map(Math.abs),h=c.indexOf(Math.max(...c));if(c[h]<sg)return null;o.push([0,1,2].map(u=>u===h?Math.sign(l[h]):0))}return r.some(l=>li(l,o[1])<.5*jt(l))||li(o[0],o[1])?null:[...o[0],...o[1],...Pi(o[0],o[1])]}function nM(i,t,e,n){let s={},r={};for(let a of Ee.names){if(!(a in t))continue;let o=n??e[a]??Ea,l=Zv[a],c=Ea;if(l in t){let h=Je(o,qu(i,t[a],t[l]));jt(h)>1e-6&&(c=ag(h,Ee.offsets[Se[l]]))}else a in eg&&(c=s[eg[a]]??c);s[a]=c,r[a]=xi(we(c,o))}return r}function ag(i,t){let e=Ze(i),n=Ze(t),s=Pi(e,n),r=li(e,n);if(r<-.999999){let l=e.map(Math.abs),c=[0,0,0];c[l.indexOf(Math.min(...l))]=1;let h=Ze(Pi(e,c));return Ke([0,...h])}let a=[0,-s[2],s[1],s[2],0,-s[0],-s[1],s[0],0],o=we(a,a);return Ea.map((l,c)=>l+a[c]+o[c]/(1+r))}var iM=(i,t)=>({...i,frames:Math.ceil(i.frames/t),fps:i.fps/t,rotation:(e,n)=>i.rotation(e*t,n),translation:(e,n)=>i.translation(e*t,n)});function og(i,t){let e=[],n=[];return i.parents.forEach((s,r)=>{let a=i.translation(t,r),o=i.rotation(t,r);e.push(s<0?a:Pe(e[s],Je(n[s],a))),n.push(s<0?o:we(n[s],o))}),{positions:e,rotations:n}}var Yu={X:[1,0,0],Y:[0,1,0],Z:[0,0,1],"-X":[-1,0,0],"-Y":[0,-1,0],"-Z":[0,0,-1]};function ig(i){let t=i.map(Math.abs),e=t.indexOf(Math.max(...t));return(i[e]>0?"":"-")+"XYZ"[e]}function sM(i,t,e){let n=Math.max(1,Math.floor(i.frames/Gv)),s=[],r=[],a=[0,0,0],o=0;for(let h=0;h<i.frames;h+=n,o++){let{positions:u}=og(i,h),f=Ne(u[t.head],De(Pe(u[t.l_ankle],u[t.r_ankle]),.5));s.push(jt(f)),r.push(u[t.pelvis]),a=Pe(a,De(f,1/Math.max(jt(f),1e-9)))}a=De(a,1/o);let l=Math.max(...a.map(Math.abs))>sg?ig(a):null,c=e&&ig(e.slice(3,6));if(l&&c&&c!==l){let h=An(r.map(u=>li(u,Yu[l])),50)/An(s,50);h>tg[0]&&h<tg[1]||(l=null)}return l??c??"Y"}function rM(i){return i==="Y"?Ea:i==="-Y"?[1,0,0,0,-1,0,0,0,-1]:ag(Yu[i],Yu.Y)}function aM(i,t,e,n,s){let{names:r,parents:a}=Ee,o=new Float32Array(i.frames*qt*4),l=new Float32Array(i.frames*3),c=De(Pe(Ee.offsets[Se.l_hip],Ee.offsets[Se.r_hip]),.5),h=r.map((u,f)=>r.map((d,m)=>m).filter(d=>a[d]===f));for(let u=0;u<i.frames;u++){let{positions:f,rotations:d}=og(i,u),m=r.map(p=>p in t?we(n,we(d[t[p]],e[p])):null);r.forEach((p,g)=>{if(m[g])return;let[y]=h[g],w=m[a[g]],b=h[g].length===1&&m[y];m[g]=b?Ke(Ii(wn(w),wn(m[y]),.5)):w});let _=Je(n,De(Pe(f[t.l_hip],f[t.r_hip]),.5));l.set(Ne(De(_,s),Je(m[0],c)),u*3),r.forEach((p,g)=>{let y=g?we(xi(m[a[g]]),m[g]):m[0];o.set(wn(y),(u*qt+g)*4)})}return Gn(o,qt*4),{frames:i.frames,quaternions:o,root:l,contacts:new Float32Array(i.frames*2),fps:i.fps,text:""}}function oM(i){if(i.frames<3)return i;let[t,e]=[0,1].map(n=>{let s=0;for(let r=0;r<qt;r++){let[a,o]=[(n*qt+r)*4,((n+1)*qt+r)*4],l=0;for(let c=0;c<4;c++)l+=i.quaternions[a+c]*i.quaternions[o+c];s+=2*Math.acos(Math.min(Math.abs(l),1))}return s/qt});return t<qv||t<5*e?i:{...i,frames:i.frames-1,quaternions:i.quaternions.slice(qt*4),root:i.root.slice(3),contacts:i.contacts.slice(2)}}function lM(i){if(Math.abs(Et/i.fps-1)<Wv)return{...i,fps:Et};let t=i.frames-1,e=t/i.fps*Et,n=Math.floor(e+Math.min(Xv*e,.5)+1e-6)+1,s=new Float32Array(n*qt*4),r=new Float32Array(n*3);for(let a=0;a<n;a++){let o=Math.min(a*i.fps/Et,t),l=Math.min(Math.floor(o),t-1),c=o-l;for(let h=0;h<qt;h++){let[u,f]=[(l*qt+h)*4,((l+1)*qt+h)*4];s.set(Ii(Array.from(i.quaternions.subarray(u,u+4)),Array.from(i.quaternions.subarray(f,f+4)),c),(a*qt+h)*4)}for(let h=0;h<3;h++)r[a*3+h]=i.root[l*3+h]+c*(i.root[l*3+3+h]-i.root[l*3+h])}return{...i,frames:n,quaternions:Gn(s,qt*4),root:r,contacts:new Float32Array(n*2),fps:Et}}function lg(i){return Array.from({length:i.frames},(t,e)=>{let{positions:n}=Ln(i,e);return Math.min(...Object.entries(Jv).map(([s,r])=>n[Se[s]][1]-r))})}function cM(i,t){let e=Array.from({length:i.frames},(a,o)=>Ln(i,o).positions),n=t?-An(lg(i),2):0,s=i.root.slice(),r=new Float32Array(i.frames*2);for(let a=0;a<i.frames;a++)s[a*3+1]+=n;return ma.forEach(({ball:a},o)=>{let l=e.map((c,h)=>{let u=Math.max(Math.min(h,i.frames-2),0),f=jt(Ne(e[u+1][a],e[u][a]))*i.fps;return+(c[a][1]+n<Kn+.06&&f<.35)});l.forEach((c,h)=>{r[h*2+o]=+((l[h-1]??c)+c+(l[h+1]??c)>=2)})}),{...i,root:s,contacts:r}}var gl=1e3,hM=1e7,ug=2e3,uM=1e6,fM=.001,fg=[1,0,0,0,1,0,0,0,1],cg="This animation is stored in a way the studio does not read.";function dg(i,t,e){try{if(/\.(glb|vrma)$/i.test(i))return Zu(pM(t),e);if(/\.bvh$/i.test(i))return Zu(dM(new TextDecoder().decode(t)),e)}catch(n){throw n.constructor===Error?n:new Error("This file is damaged; export it again.")}throw new Error("Only .bvh, .glb and .vrma can be opened.")}function dM(i){let t=i.split(/\s+/u).filter(Boolean),e=[],n=[],s=0,r=0,a=!1;for(;s<t.length&&t[s].toUpperCase()!=="MOTION";s++){let d=t[s].toUpperCase(),m=n[n.length-1];if(d==="ROOT"||d==="JOINT")e.push({name:t[++s],parent:m?e.indexOf(m):-1,offset:[0,0,0],channels:[],column:0}),n.push(e[e.length-1]);else if(d==="END")a=!0,n.push(null);else if(d==="OFFSET"&&m&&!a)m.offset=[1,2,3].map(_=>Number(t[s+_]));else if(d==="CHANNELS"&&m){let _=Number(t[s+1]);if(!(_>=0&&_<=6))throw new Error("This BVH file is damaged.");Object.assign(m,{channels:t.slice(s+2,s+2+_).map(p=>p.toUpperCase()),column:r}),r+=_}else d==="}"&&(n.pop(),a=!1);if(e.length>gl)throw new Error(`This BVH file has more than ${gl} joints.`)}let o=Number(t[s+2]),l=1/Number(t[s+5]),c=s+6;if(s>=t.length||!(o>0&&Number.isInteger(o))||!(l>=1&&l<=ug))throw new Error("This is no whole BVH file.");if(t.length-c!==o*r)throw new Error(`This BVH file says ${o} frames, but holds ${Math.floor((t.length-c)/r)}; it is cut off or damaged.`);let h=Float64Array.from(t.slice(c),Number);if(!h.every(d=>Math.abs(d)<hM))throw new Error("This BVH file holds numbers that are no angle and no place.");let u=(d,m)=>{let{channels:_,column:p}=e[m],g=fg;return _.forEach((y,w)=>{let b={XROTATION:[1,0,0],YROTATION:[0,1,0],ZROTATION:[0,0,1]}[y],E=h[d*r+p+w]*Math.PI/360;b&&(g=we(g,Ke([Math.cos(E),...b.map(T=>T*Math.sin(E))])))}),g},f=(d,m)=>{let{channels:_,column:p,offset:g}=e[m];return["X","Y","Z"].map((y,w)=>{let b=_.indexOf(`${y}POSITION`);return b<0?g[w]:h[d*r+p+b]})};return{names:e.map(({name:d})=>d),parents:e.map(({parent:d})=>d),offsets:e.map(({offset:d})=>d),frames:o,fps:l,rotation:u,translation:f}}function pM(i){let{document:t,data:e}=Xu(i),{animations:n=[]}=t,s=(t.nodes??[]).map(mM);if(!n[0]?.channels.length)throw new Error("There is no animation in this file.");if(s.length>gl)throw new Error(`This file has more than ${gl} joints.`);let r=new Array(s.length).fill(-1),a=[];s.forEach(({children:E=[]},T)=>E.forEach(x=>{r[x]=T}));let o=E=>{a.push(E),(s[E].children??[]).forEach(o)};r.forEach((E,T)=>{E<0&&o(T)});let l=_M(t,e,n[0]),c=t.extensions?.VRMC_vrm_animation?.humanoid?.humanBones??{},h=new Map(Object.entries(c).map(([E,{node:T}])=>[T,E])),u=new Map(a.map((E,T)=>[E,T])),f=[],d=[],m=E=>{let[T,x,A,F]=s[E].rotation??[0,0,0,1];return Ke([F,T,x,A])},_=a.map(E=>r[E]<0?-1:u.get(r[E]));a.forEach((E,T)=>{let x=_[T],[A]=s[E].scale??[1];f.push(x<0?m(E):we(f[x],m(E))),d.push((x<0?1:d[x])*A)});let p=E=>_[E]<0?fg:f[_[E]],g=E=>_[E]<0?1:d[_[E]],y=(E,T)=>Je(p(E),T).map(x=>x*g(E)),{times:w,fps:b}=gM([...l.values()].map(({times:E})=>E));return{names:a.map(E=>h.get(E)??s[E].name??""),parents:_,offsets:a.map((E,T)=>y(T,s[E].translation??[0,0,0])),frames:w.length,fps:b,up:"Y",rotation:(E,T)=>{let x=l.get(`${a[T]} rotation`),A=x?Ke(hg(x,w[E])):m(a[T]);return we(we(p(T),A),xi(f[T]))},translation:(E,T)=>{let x=l.get(`${a[T]} translation`);return y(T,x?hg(x,w[E]):s[a[T]].translation??[0,0,0])}}}function mM(i){if(!i.matrix)return i;let t=r=>i.matrix.slice(4*r,4*r+3),e=[0,1,2].map(r=>jt(t(r))),[n,...s]=wn(xi([0,1,2].flatMap(r=>Ze(t(r)))));return{...i,translation:t(3),rotation:[...s,n],scale:e}}function gM(i){let t=i.reduce((h,u)=>u.length>h.length?u:h),e=Math.min(...i.map(h=>h[0])),n=Math.max(...i.map(h=>h[h.length-1])),s=t.length-1;if(s<1)return{times:t,fps:Et};let r=Array.from(t.subarray(1),(h,u)=>h-t[u]),a=(n-e)/s,o=t.every((h,u)=>Math.abs(h-e-u*a)<fM*a),l=1/(o?a:An(r,50)),c=Math.round(l*100)/100;if(Math.abs(l-c)<1e-4&&(l=c),!(l>=1&&l<=ug))throw new Error(`This file moves at ${l.toFixed(2)} frames a second.`);return{times:o?t:Array.from({length:Math.min(Math.round((n-e)*l)+1,uM)},(h,u)=>e+u/l),fps:l}}function _M(i,t,e){let n=r=>{let{bufferView:a,byteOffset:o=0,count:l,type:c,componentType:h}=i.accessors[r],u={SCALAR:1,VEC3:3,VEC4:4}[c],f=i.bufferViews[a];if(!f||h!==5126||!u||(f.byteStride??u*4)!==u*4)throw new Error(cg);let d=(f.byteOffset??0)+o;if(!(d+l*u*4<=t.length))throw new Error("This file is cut off.");return new Float32Array(t.slice(d,d+l*u*4).buffer)},s=e.channels.filter(({target:{node:r,path:a}})=>r!==void 0&&a!=="weights");return new Map(s.map(({sampler:r,target:a})=>{let{input:o,output:l,interpolation:c="LINEAR"}=e.samplers[r];if(c==="CUBICSPLINE")throw new Error(cg);return[`${a.node} ${a.path}`,{times:n(o),values:n(l),steps:c==="STEP"}]}))}function hg({times:i,values:t,steps:e},n){let s=0,r=i.length-1;for(;r-s>1;){let u=s+r>>1;i[u]<=n+1e-6?s=u:r=u}let a=r===s?0:Math.min(Math.max((n-i[s])/(i[r]-i[s]),0),1);e&&(a=Math.floor(a+1e-6));let o=t.length/i.length,l=u=>Array.from(t.subarray(u*o,u*o+o)),[c,h]=[l(s),l(r)];return o===3?c.map((u,f)=>u+a*(h[f]-u)):a<1e-6?Ju(c):Ii(wn(Ke(Ju(c))),wn(Ke(Ju(h))),a)}var Ju=([i,t,e,n])=>[n,i,t,e];var yM=["video/mp4;codecs=avc1.42E01F","video/webm;codecs=vp9","video/webm;codecs=vp8","video/webm"];async function pg(i,t,e){let n=globalThis.MediaRecorder&&yM.find(l=>MediaRecorder.isTypeSupported(l));if(!n||!i.captureStream)throw new Error("This browser records no films.");let s=new MediaRecorder(i.captureStream(60),{mimeType:n,videoBitsPerSecond:6e6}),r=[];s.ondataavailable=({data:l})=>r.push(l);let a=new Promise(l=>{s.onstop=l});e(0),s.start();let o=performance.now();return await new Promise(l=>{let c=h=>{let u=(h-o)/1e3;e(Math.min(Math.max(u,0),t))&&u<t+.2?requestAnimationFrame(c):l()};requestAnimationFrame(c)}),s.stop(),await a,{blob:new Blob(r,{type:n.split(";")[0]}),kind:n.includes("mp4")?"mp4":"webm"}}var _l=class i{waiting=new Map;count=0;workers=[];static async open(t,e,n,s){let r=new i,a=URL.createObjectURL(new Blob([t],{type:"text/javascript"}));return Object.assign(r,{address:a,settings:e,parts:n,texts:s}),r.opened=r.start(),await r.opened,r}async start(){let{settings:t,texts:e}=this,n=null,s=null;try{n=this.worker=this.begin(),n.onmessage=({data:l})=>this.heard(l);let r=new Promise((l,c)=>{n.onerror=h=>c(new Error(h.message||"no worker"))});this.send("prepare",{settings:t,texts:e}).catch(()=>null),s=await Promise.race([this.parts,r]);let a=Promise.race([this.send("open",{settings:t,parts:s}),r]),o=navigator.hardwareConcurrency>1&&(navigator.deviceMemory??8)>=4?this.getHelp(s).catch(()=>null):null;await a,o?.then(l=>l&&this.worker===n&&this.send("helper",{port:l},[l])).catch(()=>null)}catch{if(n&&this.worker!==n)return;n?.terminate(),this.worker=null,this.answer=Wu(),await this.send("open",{settings:t,parts:s??await this.parts})}}begin(){let t=new Worker(this.address);return this.workers.push(t),t}stop(){if(this.worker){for(let t of this.workers.splice(0))t.onmessage=null,t.terminate();for(let{reject:t}of this.waiting.values())t(new Error("stopped"));this.waiting.clear(),this.opened=this.start()}}async getHelp({wasm:t,graph:e,adapted:n,weights:s}){let r=this.begin(),{port1:a,port2:o}=new MessageChannel;return await new Promise((l,c)=>{r.onmessage=({data:h})=>h.error?c(new Error(h.error)):l(),r.onerror=c,r.postMessage({id:0,call:"help",parts:{wasm:t,graph:e,adapted:n,weights:s},names:this.settings.weights,port:o},[o])}),a}async call(t,e,n=null){return await this.opened,this.send(t,e,[],n)}send(t,e,n=[],s=null){return this.worker?new Promise((r,a)=>{this.waiting.set(++this.count,{resolve:r,reject:a,told:s}),this.worker.postMessage({id:this.count,call:t,...e},n)}):this.answer(t,e,s??(()=>{}))}heard({id:t,result:e,error:n,progress:s}){let{resolve:r,reject:a,told:o}=this.waiting.get(t);if(s!==void 0){o?.(s);return}this.waiting.delete(t),n===void 0?r(e):a(new Error(n))}};async function mg(i){i.readyState==="loading"&&await new Promise(n=>i.addEventListener("DOMContentLoaded",n));let t=[...i.querySelectorAll('script[id^="part-"]')],e=await Promise.all(t.map(async n=>{let s=xM(n.textContent);return n.remove(),[n.id.slice(5),await vM(s)]}));return Object.fromEntries(e)}function xM(i){if(Uint8Array.fromBase64)return Uint8Array.fromBase64(i);let t=atob(i),e=new Uint8Array(t.length);for(let n=0;n<t.length;n++)e[n]=t.charCodeAt(n);return e}async function vM(i){let t=new Blob([i]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(t).arrayBuffer())}var MM={en:["a person walks forward","a person waves with the right hand","a person jumps"],es:["una persona corre","una persona salta"],fr:["une personne salue de la main","une personne marche"],de:["eine Person verbeugt sich","eine Person geht drei Meter und winkt dann"],ja:["人が歩く","人が右手を振る"],zh:["一个人向前走","一个人跳"]},_g=i=>i.flatMap(t=>(MM[t]??[]).map(e=>({language:t,prompt:e}))),gg=(i,t,e,n)=>Array.from({length:n},(s,r)=>{let a=t+(e-t)*r/(n-1);return[i-i*Math.cos(a),i*Math.sin(a)].map(o=>Math.round(o*100)/100+0)}),Aa={none:{label:"its own way",points:null},draw:{label:"draw one …"},straight:{label:"straight, 4 m",points:[[0,0],[0,4]]},left:{label:"a bend to the left",points:gg(2,0,Math.PI/2,12)},circle:{label:"a circle, 3 m across",points:gg(1.5,0,2*Math.PI,25)},zigzag:{label:"a zigzag",points:[[0,0],[.8,1.2],[-.8,2.4],[0,3.6]]},drawn:{label:"as drawn"},clip:{label:"none with a clip"}};var Qe={blocks:24,text:300,seconds:[.5,30],takes:4,seed:2147483647,points:400,room:50},bM=1,yg={blocks:[{text:"a person waves",seconds:4}],seed:0,takes:2,chosen:0,path:null,clip:null},Ds=(i,[t,e],n)=>{let s=Number(i);return Number.isFinite(s)?Math.min(Math.max(s,t),e):n},Ku=(i,t,e)=>Math.round(Ds(i,t,e)),Ta=i=>i.reduce((t,{seconds:e})=>t+e,0);function xg(i){if(typeof i!="object"||i===null||!Array.isArray(i.blocks)||!i.blocks.length)return null;let t=i.blocks.slice(0,Qe.blocks).map(s=>({text:String(s?.text??"").slice(0,Qe.text),seconds:Math.round(Ds(s?.seconds,Qe.seconds,4)*10)/10})),e=Ku(i.takes,[1,Qe.takes],1),n=null;if(Array.isArray(i.path)&&i.path.length>1){let s=[-Qe.room,Qe.room];n=i.path.slice(0,Qe.points).map(r=>[0,1].map(a=>Math.round(Ds(r?.[a],s,0)*100)/100)),n.every(r=>Math.hypot(r[0]-n[0][0],r[1]-n[0][1])<.05)&&(n=null)}return{blocks:t,seed:Ku(i.seed,[0,Qe.seed],0),takes:e,chosen:Ku(i.chosen,[0,e-1],0),path:n,clip:i.clip??null}}function vg(i){let t=new TextEncoder().encode(JSON.stringify({v:bM,...i,clip:void 0})),e="";for(let n of t)e+=String.fromCharCode(n);return btoa(e).replaceAll("+","-").replaceAll("/","_").replaceAll("=","")}function ju(i){try{let t=atob(i.replace(/^#/,"").replaceAll("-","+").replaceAll("_","/"));return xg({...JSON.parse(new TextDecoder().decode(Uint8Array.from(t,e=>e.charCodeAt(0)))),clip:null})}catch{return null}}var yl=class{constructor(t,e){Object.assign(this,{now:t,past:[],future:[],changed:e})}change(t,e=null){let n=xg({...this.now,...t});if(n){if(JSON.stringify(n)===JSON.stringify(this.now)){this.changed();return}(e===null||e!==this.kind)&&this.past.push(this.now),this.past=this.past.slice(-200),this.future=[],this.kind=e,this.now=n,this.changed()}}rest(){this.kind=null}undo(){this.move(this.past,this.future)}redo(){this.move(this.future,this.past)}move(t,e){t.length&&(e.push(this.now),this.now=t.pop(),this.kind=null,this.changed())}};var ms={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},gs={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},n0=0,Lf=1,i0=2;var Vs=1,s0=2,$r=3,_s=0,In=1,Ei=2,Hs=0,qr=1,Nf=2,Df=3,Of=4,r0=5;var Ws=100,a0=101,o0=102,l0=103,c0=104,h0=200,u0=201,f0=202,d0=203,Uf=204,Ff=205,p0=206,m0=207,g0=208,_0=209,y0=210,x0=211,v0=212,M0=213,b0=214,Wl=0,Xl=1,$l=2,Nr=3,ql=4,Yl=5,Zl=6,Jl=7,Mc=0,w0=1,S0=2,Ai=0,Bf=1,kf=2,zf=3,Gf=4,Vf=5,Hf=6,Wf=7,wf="attached",E0="detached",Xf=300,Xs=301,Yr=302,bc=303,wc=304,Kl=1e3,bi=1001,jl=1002,hn=1003,A0=1004;var ho=1005;var Cn=1006,Sc=1007;var qi=1008;var Un=1009,$f=1010,qf=1011,Zr=1012,Ec=1013,pi=1014,si=1015,mi=1016,Ac=1017,Tc=1018,$s=1020,Yf=35902,Zf=35899,Jf=1021,Kf=1022,ri=1023,Gi=1026,Yi=1027,jf=1028,Rc=1029,ys=1030,Cc=1031;var Pc=1033,uo=33776,fo=33777,po=33778,mo=33779,Ic=35840,Lc=35841,Nc=35842,Dc=35843,Oc=36196,Uc=37492,Fc=37496,Bc=37488,kc=37489,go=37490,zc=37491,Gc=37808,Vc=37809,Hc=37810,Wc=37811,Xc=37812,$c=37813,qc=37814,Yc=37815,Zc=37816,Jc=37817,Kc=37818,jc=37819,Qc=37820,th=37821,eh=36492,nh=36494,ih=36495,sh=36283,rh=36284,_o=36285,ah=36286;var Fa=2300,Ql=2301,Vl=2302,Sf=2303,Ef=2400,Af=2401,Tf=2402;var T0=3200;var oh=0,R0=1,Zi="",yn="srgb",Ba="srgb-linear",ka="linear",ve="srgb";var Hl=7680;var C0=519,P0=512,I0=513,L0=514,Qf=515,N0=516,D0=517,td=518,ed=519,O0=35044;var nd="300 es",ii=2e3,Dr=2001;function wM(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function SM(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function za(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function U0(){let i=za("canvas");return i.style.display="block",i}var Mg={},Or=null;function id(...i){let t="THREE."+i.shift();Or?Or("log",t,...i):console.log(t,...i)}function F0(i){let t=i[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=i[1];e&&e.isStackTrace?i[0]+=" "+e.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Ut(...i){i=F0(i);let t="THREE."+i.shift();if(Or)Or("warn",t,...i);else{let e=i[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...i)}}function Ht(...i){i=F0(i);let t="THREE."+i.shift();if(Or)Or("error",t,...i);else{let e=i[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...i)}}function Da(...i){let t=i.join(" ");t in Mg||(Mg[t]=!0,Ut(...i))}function B0(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var k0={[Wl]:Wl,[$l]:Zl,[ql]:ql,[Nr]:Yl,[Xl]:Xl,[Zl]:$l,[Jl]:Jl,[Yl]:Nr},di=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){let n=this._listeners;return n===void 0?!1:n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){let n=this._listeners;if(n===void 0)return;let s=n[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let n=e[t.type];if(n!==void 0){t.target=this;let s=n.slice(0);for(let r=0,a=s.length;r<a;r++)s[r].call(this,t);t.target=null}}},gn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],bg=1234567,Oa=Math.PI/180,Ur=180/Math.PI;function qs(){let i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(gn[i&255]+gn[i>>8&255]+gn[i>>16&255]+gn[i>>24&255]+"-"+gn[t&255]+gn[t>>8&255]+"-"+gn[t>>16&15|64]+gn[t>>24&255]+"-"+gn[e&63|128]+gn[e>>8&255]+"-"+gn[e>>16&255]+gn[e>>24&255]+gn[n&255]+gn[n>>8&255]+gn[n>>16&255]+gn[n>>24&255]).toLowerCase()}function se(i,t,e){return Math.max(t,Math.min(e,i))}function sd(i,t){return(i%t+t)%t}function EM(i,t,e,n,s){return n+(i-t)*(s-n)/(e-t)}function AM(i,t,e){return i!==t?(e-i)/(t-i):0}function Ua(i,t,e){return(1-e)*i+e*t}function TM(i,t,e,n){return Ua(i,t,1-Math.exp(-e*n))}function RM(i,t=1){return t-Math.abs(sd(i,t*2)-t)}function CM(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*(3-2*i))}function PM(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*i*(i*(i*6-15)+10))}function IM(i,t){return i+Math.floor(Math.random()*(t-i+1))}function LM(i,t){return i+Math.random()*(t-i)}function NM(i){return i*(.5-Math.random())}function DM(i){i!==void 0&&(bg=i);let t=bg+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function OM(i){return i*Oa}function UM(i){return i*Ur}function FM(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function BM(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function rd(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function kM(i,t,e,n,s){let r=Math.cos,a=Math.sin,o=r(e/2),l=a(e/2),c=r((t+n)/2),h=a((t+n)/2),u=r((t-n)/2),f=a((t-n)/2),d=r((n-t)/2),m=a((n-t)/2);switch(s){case"XYX":i.set(o*h,l*u,l*f,o*c);break;case"YZY":i.set(l*f,o*h,l*u,o*c);break;case"ZXZ":i.set(l*u,l*f,o*h,o*c);break;case"XZX":i.set(o*h,l*m,l*d,o*c);break;case"YXY":i.set(l*d,o*h,l*m,o*c);break;case"ZYZ":i.set(l*m,l*d,o*h,o*c);break;default:Ut("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function ad(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function z0(i,t){if(t.constructor===Float32Array)return i;let e=ad(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/e,-1)}function G0(i,t){if(t.constructor===Float32Array)return i;let e=ad(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*e)}var od={DEG2RAD:Oa,RAD2DEG:Ur,generateUUID:qs,clamp:se,euclideanModulo:sd,mapLinear:EM,inverseLerp:AM,lerp:Ua,damp:TM,pingpong:RM,smoothstep:CM,smootherstep:PM,randInt:IM,randFloat:LM,randFloatSpread:NM,seededRandom:DM,degToRad:OM,radToDeg:UM,isPowerOfTwo:FM,ceilPowerOfTwo:BM,floorPowerOfTwo:rd,setQuaternionFromProperEuler:kM,normalize:G0,denormalize:z0},zt=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=se(this.x,t.x,e.x),this.y=se(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=se(this.x,t,e),this.y=se(this.y,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(se(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(se(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,a=this.y-t.y;return this.x=r*n-a*s+t.x,this.y=r*s+a*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},xn=class{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,a,o){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],f=r[a+0],d=r[a+1],m=r[a+2],_=r[a+3];if(u!==_||l!==f||c!==d||h!==m){let p=l*f+c*d+h*m+u*_;p<0&&(f=-f,d=-d,m=-m,_=-_,p=-p);let g=1-o;if(p<.9995){let y=Math.acos(p),w=Math.sin(y);g=Math.sin(g*y)/w,o=Math.sin(o*y)/w,l=l*g+f*o,c=c*g+d*o,h=h*g+m*o,u=u*g+_*o}else{l=l*g+f*o,c=c*g+d*o,h=h*g+m*o,u=u*g+_*o;let y=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=y,c*=y,h*=y,u*=y}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,s,r,a){let o=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[a],f=r[a+1],d=r[a+2],m=r[a+3];return t[e]=o*m+h*u+l*d-c*f,t[e+1]=l*m+h*f+c*u-o*d,t[e+2]=c*m+h*d+o*f-l*u,t[e+3]=h*m-o*u-l*f-c*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,s=t._y,r=t._z,a=t._order,o=Math.cos,l=Math.sin,c=o(n/2),h=o(s/2),u=o(r/2),f=l(n/2),d=l(s/2),m=l(r/2);switch(a){case"XYZ":this._x=f*h*u+c*d*m,this._y=c*d*u-f*h*m,this._z=c*h*m+f*d*u,this._w=c*h*u-f*d*m;break;case"YXZ":this._x=f*h*u+c*d*m,this._y=c*d*u-f*h*m,this._z=c*h*m-f*d*u,this._w=c*h*u+f*d*m;break;case"ZXY":this._x=f*h*u-c*d*m,this._y=c*d*u+f*h*m,this._z=c*h*m+f*d*u,this._w=c*h*u-f*d*m;break;case"ZYX":this._x=f*h*u-c*d*m,this._y=c*d*u+f*h*m,this._z=c*h*m-f*d*u,this._w=c*h*u+f*d*m;break;case"YZX":this._x=f*h*u+c*d*m,this._y=c*d*u+f*h*m,this._z=c*h*m-f*d*u,this._w=c*h*u-f*d*m;break;case"XZY":this._x=f*h*u-c*d*m,this._y=c*d*u-f*h*m,this._z=c*h*m+f*d*u,this._w=c*h*u+f*d*m;break;default:Ut("Quaternion: .setFromEuler() encountered an unknown order: "+a)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],s=e[4],r=e[8],a=e[1],o=e[5],l=e[9],c=e[2],h=e[6],u=e[10],f=n+o+u;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(h-l)*d,this._y=(r-c)*d,this._z=(a-s)*d}else if(n>o&&n>u){let d=2*Math.sqrt(1+n-o-u);this._w=(h-l)/d,this._x=.25*d,this._y=(s+a)/d,this._z=(r+c)/d}else if(o>u){let d=2*Math.sqrt(1+o-n-u);this._w=(r-c)/d,this._x=(s+a)/d,this._y=.25*d,this._z=(l+h)/d}else{let d=2*Math.sqrt(1+u-n-o);this._w=(a-s)/d,this._x=(r+c)/d,this._y=(l+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<1e-8?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(se(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,s=t._y,r=t._z,a=t._w,o=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+a*o+s*c-r*l,this._y=s*h+a*l+r*o-n*c,this._z=r*h+a*c+n*l-s*o,this._w=a*h-n*o-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let n=t._x,s=t._y,r=t._z,a=t._w,o=this.dot(t);o<0&&(n=-n,s=-s,r=-r,a=-a,o=-o);let l=1-e;if(o<.9995){let c=Math.acos(o),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+a*e,this._onChangeCallback()}else this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+a*e,this.normalize();return this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},B=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,n=0){this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(wg.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(wg.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=t.elements,a=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*a,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*a,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*a,this}applyQuaternion(t){let e=this.x,n=this.y,s=this.z,r=t.x,a=t.y,o=t.z,l=t.w,c=2*(a*s-o*n),h=2*(o*e-r*s),u=2*(r*n-a*e);return this.x=e+l*c+a*u-o*h,this.y=n+l*h+o*c-r*u,this.z=s+l*u+r*h-a*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=se(this.x,t.x,e.x),this.y=se(this.y,t.y,e.y),this.z=se(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=se(this.x,t,e),this.y=se(this.y,t,e),this.z=se(this.z,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(se(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,s=t.y,r=t.z,a=e.x,o=e.y,l=e.z;return this.x=s*l-r*o,this.y=r*a-n*l,this.z=n*o-s*a,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return Qu.copy(this).projectOnVector(t),this.sub(Qu)}reflect(t){return this.sub(Qu.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(se(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Qu=new B,wg=new xn,$t=class{static{this.prototype.isMatrix3=!0}constructor(t,e,n,s,r,a,o,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,a,o,l,c)}set(t,e,n,s,r,a,o,l,c){let h=this.elements;return h[0]=t,h[1]=s,h[2]=o,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=a,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,a=n[0],o=n[3],l=n[6],c=n[1],h=n[4],u=n[7],f=n[2],d=n[5],m=n[8],_=s[0],p=s[3],g=s[6],y=s[1],w=s[4],b=s[7],E=s[2],T=s[5],x=s[8];return r[0]=a*_+o*y+l*E,r[3]=a*p+o*w+l*T,r[6]=a*g+o*b+l*x,r[1]=c*_+h*y+u*E,r[4]=c*p+h*w+u*T,r[7]=c*g+h*b+u*x,r[2]=f*_+d*y+m*E,r[5]=f*p+d*w+m*T,r[8]=f*g+d*b+m*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8];return e*a*h-e*o*c-n*r*h+n*o*l+s*r*c-s*a*l}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8],u=h*a-o*c,f=o*l-h*r,d=c*r-a*l,m=e*u+n*f+s*d;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/m;return t[0]=u*_,t[1]=(s*c-h*n)*_,t[2]=(o*n-s*a)*_,t[3]=f*_,t[4]=(h*e-s*l)*_,t[5]=(s*r-o*e)*_,t[6]=d*_,t[7]=(n*l-c*e)*_,t[8]=(a*e-n*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,a,o){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*a+c*o)+a+t,-s*c,s*l,-s*(-c*a+l*o)+o+e,0,0,1),this}scale(t,e){return Da("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(tf.makeScale(t,e)),this}rotate(t){return Da("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(tf.makeRotation(-t)),this}translate(t,e){return Da("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(tf.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}},tf=new $t,Sg=new $t().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Eg=new $t().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function zM(){let i={enabled:!0,workingColorSpace:Ba,spaces:{},convert:function(s,r,a){return this.enabled===!1||r===a||!r||!a||(this.spaces[r].transfer===ve&&(s.r=zi(s.r),s.g=zi(s.g),s.b=zi(s.b)),this.spaces[r].primaries!==this.spaces[a].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[a].fromXYZ)),this.spaces[a].transfer===ve&&(s.r=Lr(s.r),s.g=Lr(s.g),s.b=Lr(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Zi?ka:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,a){return s.copy(this.spaces[a].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[Ba]:{primaries:t,whitePoint:n,transfer:ka,toXYZ:Sg,fromXYZ:Eg,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:yn},outputColorSpaceConfig:{drawingBufferColorSpace:yn}},[yn]:{primaries:t,whitePoint:n,transfer:ve,toXYZ:Sg,fromXYZ:Eg,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:yn}}}),i}var ce=zM();function zi(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Lr(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var xr,tc=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let n;if(t instanceof HTMLCanvasElement)n=t;else{xr===void 0&&(xr=za("canvas")),xr.width=t.width,xr.height=t.height;let s=xr.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),n=xr}return n.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=za("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let a=0;a<r.length;a++)r[a]=zi(r[a]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(zi(e[n]/255)*255):e[n]=zi(e[n]);return{data:e,width:t.width,height:t.height}}else return Ut("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},GM=0,Fr=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:GM++}),this.uuid=qs(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let a=0,o=s.length;a<o;a++)s[a].isDataTexture?r.push(ef(s[a].image)):r.push(ef(s[a]))}else r=ef(s);n.url=r}return e||(t.images[this.uuid]=n),n}};function ef(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?tc.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Ut("Texture: Unable to serialize Texture."),{})}var VM=0,nf=new B,Dn=class i extends di{constructor(t=i.DEFAULT_IMAGE,e=i.DEFAULT_MAPPING,n=bi,s=bi,r=Cn,a=qi,o=ri,l=Un,c=i.DEFAULT_ANISOTROPY,h=Zi){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:VM++}),this.uuid=qs(),this.name="",this.source=new Fr(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=a,this.anisotropy=c,this.format=o,this.internalFormat=null,this.type=l,this.offset=new zt(0,0),this.repeat=new zt(1,1),this.center=new zt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new $t,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(nf).x}get height(){return this.source.getSize(nf).y}get depth(){return this.source.getSize(nf).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let n=t[e];if(n===void 0){Ut(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Ut(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Xf)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Kl:t.x=t.x-Math.floor(t.x);break;case bi:t.x=t.x<0?0:1;break;case jl:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Kl:t.y=t.y-Math.floor(t.y);break;case bi:t.y=t.y<0?0:1;break;case jl:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Dn.DEFAULT_IMAGE=null;Dn.DEFAULT_MAPPING=Xf;Dn.DEFAULT_ANISOTROPY=1;var be=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,n=0,s=1){this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=this.w,a=t.elements;return this.x=a[0]*e+a[4]*n+a[8]*s+a[12]*r,this.y=a[1]*e+a[5]*n+a[9]*s+a[13]*r,this.z=a[2]*e+a[6]*n+a[10]*s+a[14]*r,this.w=a[3]*e+a[7]*n+a[11]*s+a[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r,l=t.elements,c=l[0],h=l[4],u=l[8],f=l[1],d=l[5],m=l[9],_=l[2],p=l[6],g=l[10];if(Math.abs(h-f)<.01&&Math.abs(u-_)<.01&&Math.abs(m-p)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+_)<.1&&Math.abs(m+p)<.1&&Math.abs(c+d+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let w=(c+1)/2,b=(d+1)/2,E=(g+1)/2,T=(h+f)/4,x=(u+_)/4,A=(m+p)/4;return w>b&&w>E?w<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(w),s=T/n,r=x/n):b>E?b<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(b),n=T/s,r=A/s):E<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(E),n=x/r,s=A/r),this.set(n,s,r,e),this}let y=Math.sqrt((p-m)*(p-m)+(u-_)*(u-_)+(f-h)*(f-h));return Math.abs(y)<.001&&(y=1),this.x=(p-m)/y,this.y=(u-_)/y,this.z=(f-h)/y,this.w=Math.acos((c+d+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=se(this.x,t.x,e.x),this.y=se(this.y,t.y,e.y),this.z=se(this.z,t.z,e.z),this.w=se(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=se(this.x,t,e),this.y=se(this.y,t,e),this.z=se(this.z,t,e),this.w=se(this.w,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(se(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},ec=class extends di{constructor(t=1,e=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Cn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=n.depth,this.scissor=new be(0,0,t,e),this.scissorTest=!1,this.viewport=new be(0,0,t,e),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Dn({width:t,height:e,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Cn,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,n=t.textures.length;e<n;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new Fr(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},$n=class extends ec{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},Ga=class extends Dn{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=hn,this.minFilter=hn,this.wrapR=bi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var nc=class extends Dn{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=hn,this.minFilter=hn,this.wrapR=bi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var re=class i{static{this.prototype.isMatrix4=!0}constructor(t,e,n,s,r,a,o,l,c,h,u,f,d,m,_,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,a,o,l,c,h,u,f,d,m,_,p)}set(t,e,n,s,r,a,o,l,c,h,u,f,d,m,_,p){let g=this.elements;return g[0]=t,g[4]=e,g[8]=n,g[12]=s,g[1]=r,g[5]=a,g[9]=o,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=f,g[3]=d,g[7]=m,g[11]=_,g[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),n.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,n=t.elements,s=1/vr.setFromMatrixColumn(t,0).length(),r=1/vr.setFromMatrixColumn(t,1).length(),a=1/vr.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*a,e[9]=n[9]*a,e[10]=n[10]*a,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,s=t.y,r=t.z,a=Math.cos(n),o=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let f=a*h,d=a*u,m=o*h,_=o*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=d+m*c,e[5]=f-_*c,e[9]=-o*l,e[2]=_-f*c,e[6]=m+d*c,e[10]=a*l}else if(t.order==="YXZ"){let f=l*h,d=l*u,m=c*h,_=c*u;e[0]=f+_*o,e[4]=m*o-d,e[8]=a*c,e[1]=a*u,e[5]=a*h,e[9]=-o,e[2]=d*o-m,e[6]=_+f*o,e[10]=a*l}else if(t.order==="ZXY"){let f=l*h,d=l*u,m=c*h,_=c*u;e[0]=f-_*o,e[4]=-a*u,e[8]=m+d*o,e[1]=d+m*o,e[5]=a*h,e[9]=_-f*o,e[2]=-a*c,e[6]=o,e[10]=a*l}else if(t.order==="ZYX"){let f=a*h,d=a*u,m=o*h,_=o*u;e[0]=l*h,e[4]=m*c-d,e[8]=f*c+_,e[1]=l*u,e[5]=_*c+f,e[9]=d*c-m,e[2]=-c,e[6]=o*l,e[10]=a*l}else if(t.order==="YZX"){let f=a*l,d=a*c,m=o*l,_=o*c;e[0]=l*h,e[4]=_-f*u,e[8]=m*u+d,e[1]=u,e[5]=a*h,e[9]=-o*h,e[2]=-c*h,e[6]=d*u+m,e[10]=f-_*u}else if(t.order==="XZY"){let f=a*l,d=a*c,m=o*l,_=o*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=f*u+_,e[5]=a*h,e[9]=d*u-m,e[2]=m*u-d,e[6]=o*h,e[10]=_*u+f}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(HM,t,WM)}lookAt(t,e,n){let s=this.elements;return Wn.subVectors(t,e),Wn.lengthSq()===0&&(Wn.z=1),Wn.normalize(),ss.crossVectors(n,Wn),ss.lengthSq()===0&&(Math.abs(n.z)===1?Wn.x+=1e-4:Wn.z+=1e-4,Wn.normalize(),ss.crossVectors(n,Wn)),ss.normalize(),xl.crossVectors(Wn,ss),s[0]=ss.x,s[4]=xl.x,s[8]=Wn.x,s[1]=ss.y,s[5]=xl.y,s[9]=Wn.y,s[2]=ss.z,s[6]=xl.z,s[10]=Wn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,a=n[0],o=n[4],l=n[8],c=n[12],h=n[1],u=n[5],f=n[9],d=n[13],m=n[2],_=n[6],p=n[10],g=n[14],y=n[3],w=n[7],b=n[11],E=n[15],T=s[0],x=s[4],A=s[8],F=s[12],L=s[1],O=s[5],H=s[9],Z=s[13],P=s[2],W=s[6],tt=s[10],$=s[14],at=s[3],X=s[7],k=s[11],it=s[15];return r[0]=a*T+o*L+l*P+c*at,r[4]=a*x+o*O+l*W+c*X,r[8]=a*A+o*H+l*tt+c*k,r[12]=a*F+o*Z+l*$+c*it,r[1]=h*T+u*L+f*P+d*at,r[5]=h*x+u*O+f*W+d*X,r[9]=h*A+u*H+f*tt+d*k,r[13]=h*F+u*Z+f*$+d*it,r[2]=m*T+_*L+p*P+g*at,r[6]=m*x+_*O+p*W+g*X,r[10]=m*A+_*H+p*tt+g*k,r[14]=m*F+_*Z+p*$+g*it,r[3]=y*T+w*L+b*P+E*at,r[7]=y*x+w*O+b*W+E*X,r[11]=y*A+w*H+b*tt+E*k,r[15]=y*F+w*Z+b*$+E*it,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],a=t[1],o=t[5],l=t[9],c=t[13],h=t[2],u=t[6],f=t[10],d=t[14],m=t[3],_=t[7],p=t[11],g=t[15],y=l*d-c*f,w=o*d-c*u,b=o*f-l*u,E=a*d-c*h,T=a*f-l*h,x=a*u-o*h;return e*(_*y-p*w+g*b)-n*(m*y-p*E+g*T)+s*(m*w-_*E+g*x)-r*(m*b-_*T+p*x)}determinantAffine(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[1],a=t[5],o=t[9],l=t[2],c=t[6],h=t[10];return e*(a*h-o*c)-n*(r*h-o*l)+s*(r*c-a*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],h=t[8],u=t[9],f=t[10],d=t[11],m=t[12],_=t[13],p=t[14],g=t[15],y=e*o-n*a,w=e*l-s*a,b=e*c-r*a,E=n*l-s*o,T=n*c-r*o,x=s*c-r*l,A=h*_-u*m,F=h*p-f*m,L=h*g-d*m,O=u*p-f*_,H=u*g-d*_,Z=f*g-d*p,P=y*Z-w*H+b*O+E*L-T*F+x*A;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let W=1/P;return t[0]=(o*Z-l*H+c*O)*W,t[1]=(s*H-n*Z-r*O)*W,t[2]=(_*x-p*T+g*E)*W,t[3]=(f*T-u*x-d*E)*W,t[4]=(l*L-a*Z-c*F)*W,t[5]=(e*Z-s*L+r*F)*W,t[6]=(p*b-m*x-g*w)*W,t[7]=(h*x-f*b+d*w)*W,t[8]=(a*H-o*L+c*A)*W,t[9]=(n*L-e*H-r*A)*W,t[10]=(m*T-_*b+g*y)*W,t[11]=(u*b-h*T-d*y)*W,t[12]=(o*F-a*O-l*A)*W,t[13]=(e*O-n*F+s*A)*W,t[14]=(_*w-m*E-p*y)*W,t[15]=(h*E-u*w+f*y)*W,this}scale(t){let e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),s=Math.sin(e),r=1-n,a=t.x,o=t.y,l=t.z,c=r*a,h=r*o;return this.set(c*a+n,c*o-s*l,c*l+s*o,0,c*o+s*l,h*o+n,h*l-s*a,0,c*l-s*o,h*l+s*a,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,a){return this.set(1,n,r,0,t,1,a,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){let s=this.elements,r=e._x,a=e._y,o=e._z,l=e._w,c=r+r,h=a+a,u=o+o,f=r*c,d=r*h,m=r*u,_=a*h,p=a*u,g=o*u,y=l*c,w=l*h,b=l*u,E=n.x,T=n.y,x=n.z;return s[0]=(1-(_+g))*E,s[1]=(d+b)*E,s[2]=(m-w)*E,s[3]=0,s[4]=(d-b)*T,s[5]=(1-(f+g))*T,s[6]=(p+y)*T,s[7]=0,s[8]=(m+w)*x,s[9]=(p-y)*x,s[10]=(1-(f+_))*x,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),e.identity(),this;let a=vr.set(s[0],s[1],s[2]).length(),o=vr.set(s[4],s[5],s[6]).length(),l=vr.set(s[8],s[9],s[10]).length();r<0&&(a=-a),hi.copy(this);let c=1/a,h=1/o,u=1/l;return hi.elements[0]*=c,hi.elements[1]*=c,hi.elements[2]*=c,hi.elements[4]*=h,hi.elements[5]*=h,hi.elements[6]*=h,hi.elements[8]*=u,hi.elements[9]*=u,hi.elements[10]*=u,e.setFromRotationMatrix(hi),n.x=a,n.y=o,n.z=l,this}makePerspective(t,e,n,s,r,a,o=ii,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(n-s),f=(e+t)/(e-t),d=(n+s)/(n-s),m,_;if(l)m=r/(a-r),_=a*r/(a-r);else if(o===ii)m=-(a+r)/(a-r),_=-2*a*r/(a-r);else if(o===Dr)m=-a/(a-r),_=-a*r/(a-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+o);return c[0]=h,c[4]=0,c[8]=f,c[12]=0,c[1]=0,c[5]=u,c[9]=d,c[13]=0,c[2]=0,c[6]=0,c[10]=m,c[14]=_,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,n,s,r,a,o=ii,l=!1){let c=this.elements,h=2/(e-t),u=2/(n-s),f=-(e+t)/(e-t),d=-(n+s)/(n-s),m,_;if(l)m=1/(a-r),_=a/(a-r);else if(o===ii)m=-2/(a-r),_=-(a+r)/(a-r);else if(o===Dr)m=-1/(a-r),_=-r/(a-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+o);return c[0]=h,c[4]=0,c[8]=0,c[12]=f,c[1]=0,c[5]=u,c[9]=0,c[13]=d,c[2]=0,c[6]=0,c[10]=m,c[14]=_,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}},vr=new B,hi=new re,HM=new B(0,0,0),WM=new B(1,1,1),ss=new B,xl=new B,Wn=new B,Ag=new re,Tg=new xn,Vi=class i{constructor(t=0,e=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let s=t.elements,r=s[0],a=s[4],o=s[8],l=s[1],c=s[5],h=s[9],u=s[2],f=s[6],d=s[10];switch(e){case"XYZ":this._y=Math.asin(se(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-a,r)):(this._x=Math.atan2(f,c),this._z=0);break;case"YXZ":this._x=Math.asin(-se(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(o,d),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(se(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-a,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-se(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-a,c));break;case"YZX":this._z=Math.asin(se(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(o,d));break;case"XZY":this._z=Math.asin(-se(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(f,c),this._y=Math.atan2(o,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:Ut("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return Ag.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Ag,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Tg.setFromEuler(this),this.setFromQuaternion(Tg,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Vi.DEFAULT_ORDER="XYZ";var Br=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},XM=0,Rg=new B,Mr=new xn,Oi=new re,vl=new B,Ra=new B,$M=new B,qM=new xn,Cg=new B(1,0,0),Pg=new B(0,1,0),Ig=new B(0,0,1),Lg={type:"added"},YM={type:"removed"},br={type:"childadded",child:null},sf={type:"childremoved",child:null},un=class i extends di{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:XM++}),this.uuid=qs(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let t=new B,e=new Vi,n=new xn,s=new B(1,1,1);function r(){n.setFromEuler(e,!1)}function a(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(a),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new re},normalMatrix:{value:new $t}}),this.matrix=new re,this.matrixWorld=new re,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Br,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return Mr.setFromAxisAngle(t,e),this.quaternion.multiply(Mr),this}rotateOnWorldAxis(t,e){return Mr.setFromAxisAngle(t,e),this.quaternion.premultiply(Mr),this}rotateX(t){return this.rotateOnAxis(Cg,t)}rotateY(t){return this.rotateOnAxis(Pg,t)}rotateZ(t){return this.rotateOnAxis(Ig,t)}translateOnAxis(t,e){return Rg.copy(t).applyQuaternion(this.quaternion),this.position.add(Rg.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Cg,t)}translateY(t){return this.translateOnAxis(Pg,t)}translateZ(t){return this.translateOnAxis(Ig,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Oi.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?vl.copy(t):vl.set(t,e,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Ra.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Oi.lookAt(Ra,vl,this.up):Oi.lookAt(vl,Ra,this.up),this.quaternion.setFromRotationMatrix(Oi),s&&(Oi.extractRotation(s.matrixWorld),Mr.setFromRotationMatrix(Oi),this.quaternion.premultiply(Mr.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Ht("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Lg),br.child=t,this.dispatchEvent(br),br.child=null):Ht("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(YM),sf.child=t,this.dispatchEvent(sf),sf.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Oi.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Oi.multiply(t.parent.matrixWorld)),t.applyMatrix4(Oi),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Lg),br.child=t,this.dispatchEvent(br),br.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){let a=this.children[n].getObjectByProperty(t,e);if(a!==void 0)return a}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let s=this.children;for(let r=0,a=s.length;r<a;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ra,t,$M),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ra,qM,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,n=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*n-r[8]*s,r[13]+=n-r[1]*e-r[5]*n-r[9]*s,r[14]+=s-r[2]*e-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e,n=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),e===!0){let r=this.children;for(let a=0,o=r.length;a<o;a++)r[a].updateWorldMatrix(!1,!0,n)}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(o=>({...o,boundingBox:o.boundingBox?o.boundingBox.toJSON():void 0,boundingSphere:o.boundingSphere?o.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(o=>({...o})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(o,l){return o[l.uuid]===void 0&&(o[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let o=this.geometry.parameters;if(o!==void 0&&o.shapes!==void 0){let l=o.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let o=[];for(let l=0,c=this.material.length;l<c;l++)o.push(r(t.materials,this.material[l]));s.material=o}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let o=0;o<this.children.length;o++)s.children.push(this.children[o].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let o=0;o<this.animations.length;o++){let l=this.animations[o];s.animations.push(r(t.animations,l))}}if(e){let o=a(t.geometries),l=a(t.materials),c=a(t.textures),h=a(t.images),u=a(t.shapes),f=a(t.skeletons),d=a(t.animations),m=a(t.nodes);o.length>0&&(n.geometries=o),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),f.length>0&&(n.skeletons=f),d.length>0&&(n.animations=d),m.length>0&&(n.nodes=m)}return n.object=s,n;function a(o){let l=[];for(let c in o){let h=o[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let s=t.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};un.DEFAULT_UP=new B(0,1,0);un.DEFAULT_MATRIX_AUTO_UPDATE=!0;un.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var ks=class extends un{constructor(){super(),this.isGroup=!0,this.type="Group"}},ZM={type:"move"},kr=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new ks,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new ks,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new B,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new B),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new ks,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new B,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new B,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,a=null,o=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){a=!0;for(let _ of t.hand.values()){let p=e.getJointPose(_,n),g=this._getHandJoint(c,_);p!==null&&(g.matrix.fromArray(p.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=p.radius),g.visible=p!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],f=h.position.distanceTo(u.position),d=.02,m=.005;c.inputState.pinching&&f>d+m?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&f<=d-m&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));o!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(o.matrix.fromArray(s.transform.matrix),o.matrix.decompose(o.position,o.quaternion,o.scale),o.matrixWorldNeedsUpdate=!0,s.linearVelocity?(o.hasLinearVelocity=!0,o.linearVelocity.copy(s.linearVelocity)):o.hasLinearVelocity=!1,s.angularVelocity?(o.hasAngularVelocity=!0,o.angularVelocity.copy(s.angularVelocity)):o.hasAngularVelocity=!1,this.dispatchEvent(ZM)))}return o!==null&&(o.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=a!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new ks;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},V0={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},rs={h:0,s:0,l:0},Ml={h:0,s:0,l:0};function rf(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}var Jt=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=yn){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,ce.colorSpaceToWorking(this,e),this}setRGB(t,e,n,s=ce.workingColorSpace){return this.r=t,this.g=e,this.b=n,ce.colorSpaceToWorking(this,s),this}setHSL(t,e,n,s=ce.workingColorSpace){if(t=sd(t,1),e=se(e,0,1),n=se(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,a=2*n-r;this.r=rf(a,r,t+1/3),this.g=rf(a,r,t),this.b=rf(a,r,t-1/3)}return ce.colorSpaceToWorking(this,s),this}setStyle(t,e=yn){function n(r){r!==void 0&&parseFloat(r)<1&&Ut("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,a=s[1],o=s[2];switch(a){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Ut("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],a=r.length;if(a===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(a===6)return this.setHex(parseInt(r,16),e);Ut("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=yn){let n=V0[t.toLowerCase()];return n!==void 0?this.setHex(n,e):Ut("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=zi(t.r),this.g=zi(t.g),this.b=zi(t.b),this}copyLinearToSRGB(t){return this.r=Lr(t.r),this.g=Lr(t.g),this.b=Lr(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=yn){return ce.workingToColorSpace(_n.copy(this),t),Math.round(se(_n.r*255,0,255))*65536+Math.round(se(_n.g*255,0,255))*256+Math.round(se(_n.b*255,0,255))}getHexString(t=yn){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=ce.workingColorSpace){ce.workingToColorSpace(_n.copy(this),e);let n=_n.r,s=_n.g,r=_n.b,a=Math.max(n,s,r),o=Math.min(n,s,r),l,c,h=(o+a)/2;if(o===a)l=0,c=0;else{let u=a-o;switch(c=h<=.5?u/(a+o):u/(2-a-o),a){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=ce.workingColorSpace){return ce.workingToColorSpace(_n.copy(this),e),t.r=_n.r,t.g=_n.g,t.b=_n.b,t}getStyle(t=yn){ce.workingToColorSpace(_n.copy(this),t);let e=_n.r,n=_n.g,s=_n.b;return t!==yn?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(rs),this.setHSL(rs.h+t,rs.s+e,rs.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(rs),t.getHSL(Ml);let n=Ua(rs.h,Ml.h,e),s=Ua(rs.s,Ml.s,e),r=Ua(rs.l,Ml.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},_n=new Jt;Jt.NAMES=V0;var Va=class i{constructor(t,e=1,n=1e3){this.isFog=!0,this.name="",this.color=new Jt(t),this.near=e,this.far=n}clone(){return new i(this.color,this.near,this.far)}toJSON(){return{type:"Fog",name:this.name,color:this.color.getHex(),near:this.near,far:this.far}}},Ha=class extends un{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Vi,this.environmentIntensity=1,this.environmentRotation=new Vi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},ui=new B,Ui=new B,af=new B,Fi=new B,wr=new B,Sr=new B,Ng=new B,of=new B,lf=new B,cf=new B,hf=new be,uf=new be,ff=new be,cs=class i{constructor(t=new B,e=new B,n=new B){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),ui.subVectors(t,e),s.cross(ui);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){ui.subVectors(s,e),Ui.subVectors(n,e),af.subVectors(t,e);let a=ui.dot(ui),o=ui.dot(Ui),l=ui.dot(af),c=Ui.dot(Ui),h=Ui.dot(af),u=a*c-o*o;if(u===0)return r.set(0,0,0),null;let f=1/u,d=(c*l-o*h)*f,m=(a*h-o*l)*f;return r.set(1-d-m,m,d)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,Fi)===null?!1:Fi.x>=0&&Fi.y>=0&&Fi.x+Fi.y<=1}static getInterpolation(t,e,n,s,r,a,o,l){return this.getBarycoord(t,e,n,s,Fi)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Fi.x),l.addScaledVector(a,Fi.y),l.addScaledVector(o,Fi.z),l)}static getInterpolatedAttribute(t,e,n,s,r,a){return hf.setScalar(0),uf.setScalar(0),ff.setScalar(0),hf.fromBufferAttribute(t,e),uf.fromBufferAttribute(t,n),ff.fromBufferAttribute(t,s),a.setScalar(0),a.addScaledVector(hf,r.x),a.addScaledVector(uf,r.y),a.addScaledVector(ff,r.z),a}static isFrontFacing(t,e,n,s){return ui.subVectors(n,e),Ui.subVectors(t,e),ui.cross(Ui).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return ui.subVectors(this.c,this.b),Ui.subVectors(this.a,this.b),ui.cross(Ui).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return i.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return i.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return i.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return i.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return i.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,s=this.b,r=this.c,a,o;wr.subVectors(s,n),Sr.subVectors(r,n),of.subVectors(t,n);let l=wr.dot(of),c=Sr.dot(of);if(l<=0&&c<=0)return e.copy(n);lf.subVectors(t,s);let h=wr.dot(lf),u=Sr.dot(lf);if(h>=0&&u<=h)return e.copy(s);let f=l*u-h*c;if(f<=0&&l>=0&&h<=0&&l-h>0)return a=l/(l-h),e.copy(n).addScaledVector(wr,a);cf.subVectors(t,r);let d=wr.dot(cf),m=Sr.dot(cf);if(m>=0&&d<=m)return e.copy(r);let _=d*c-l*m;if(_<=0&&c>=0&&m<=0)return o=c/(c-m),e.copy(n).addScaledVector(Sr,o);let p=h*m-d*u;if(p<=0&&u-h>=0&&d-m>=0)return Ng.subVectors(r,s),o=(u-h)/(u-h+(d-m)),e.copy(s).addScaledVector(Ng,o);let g=1/(p+_+f);return a=_*g,o=f*g,e.copy(n).addScaledVector(wr,a).addScaledVector(Sr,o)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},Hi=class{constructor(t=new B(1/0,1/0,1/0),e=new B(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(fi.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(fi.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=fi.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let a=0,o=r.count;a<o;a++)t.isMesh===!0?t.getVertexPosition(a,fi):fi.fromBufferAttribute(r,a),fi.applyMatrix4(t.matrixWorld),this.expandByPoint(fi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),bl.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),bl.copy(n.boundingBox)),bl.applyMatrix4(t.matrixWorld),this.union(bl)}let s=t.children;for(let r=0,a=s.length;r<a;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,fi),fi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(Ca),wl.subVectors(this.max,Ca),Er.subVectors(t.a,Ca),Ar.subVectors(t.b,Ca),Tr.subVectors(t.c,Ca),as.subVectors(Ar,Er),os.subVectors(Tr,Ar),Os.subVectors(Er,Tr);let e=[0,-as.z,as.y,0,-os.z,os.y,0,-Os.z,Os.y,as.z,0,-as.x,os.z,0,-os.x,Os.z,0,-Os.x,-as.y,as.x,0,-os.y,os.x,0,-Os.y,Os.x,0];return!df(e,Er,Ar,Tr,wl)||(e=[1,0,0,0,1,0,0,0,1],!df(e,Er,Ar,Tr,wl))?!1:(Sl.crossVectors(as,os),e=[Sl.x,Sl.y,Sl.z],df(e,Er,Ar,Tr,wl))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,fi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(fi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Bi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Bi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Bi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Bi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Bi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Bi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Bi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Bi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Bi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},Bi=[new B,new B,new B,new B,new B,new B,new B,new B],fi=new B,bl=new Hi,Er=new B,Ar=new B,Tr=new B,as=new B,os=new B,Os=new B,Ca=new B,wl=new B,Sl=new B,Us=new B;function df(i,t,e,n,s){for(let r=0,a=i.length-3;r<=a;r+=3){Us.fromArray(i,r);let o=s.x*Math.abs(Us.x)+s.y*Math.abs(Us.y)+s.z*Math.abs(Us.z),l=t.dot(Us),c=e.dot(Us),h=n.dot(Us);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>o)return!1}return!0}var $e=new B,El=new zt,JM=0,cn=class extends di{constructor(t,e,n=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:JM++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=O0,this.updateRanges=[],this.gpuType=si,this.version=0,this._normalizationScale=t!==void 0?ad(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)El.fromBufferAttribute(this,e),El.applyMatrix3(t),this.setXY(e,El.x,El.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)$e.fromBufferAttribute(this,e),$e.applyMatrix3(t),this.setXYZ(e,$e.x,$e.y,$e.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)$e.fromBufferAttribute(this,e),$e.applyMatrix4(t),this.setXYZ(e,$e.x,$e.y,$e.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)$e.fromBufferAttribute(this,e),$e.applyNormalMatrix(t),this.setXYZ(e,$e.x,$e.y,$e.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)$e.fromBufferAttribute(this,e),$e.transformDirection(t),this.setXYZ(e,$e.x,$e.y,$e.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):z0(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):G0(t,this.array)}};var Wa=class extends cn{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var Xa=class extends cn{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var dn=class extends cn{constructor(t,e,n){super(new Float32Array(t),e,n)}},KM=new Hi,Pa=new B,pf=new B,Wi=class{constructor(t=new B,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):KM.setFromPoints(t).getCenter(n);let s=0;for(let r=0,a=t.length;r<a;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;Pa.subVectors(t,this.center);let e=Pa.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(Pa,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(pf.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(Pa.copy(t.center).add(pf)),this.expandByPoint(Pa.copy(t.center).sub(pf))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},jM=0,ni=new re,mf=new un,Rr=new B,Xn=new Hi,Ia=new Hi,ln=new B,Pn=class i extends di{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:jM++}),this.uuid=qs(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(wM(t)?Xa:Wa)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new $t().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return ni.makeRotationFromQuaternion(t),this.applyMatrix4(ni),this}rotateX(t){return ni.makeRotationX(t),this.applyMatrix4(ni),this}rotateY(t){return ni.makeRotationY(t),this.applyMatrix4(ni),this}rotateZ(t){return ni.makeRotationZ(t),this.applyMatrix4(ni),this}translate(t,e,n){return ni.makeTranslation(t,e,n),this.applyMatrix4(ni),this}scale(t,e,n){return ni.makeScale(t,e,n),this.applyMatrix4(ni),this}lookAt(t){return mf.lookAt(t),mf.updateMatrix(),this.applyMatrix4(mf.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Rr).negate(),this.translate(Rr.x,Rr.y,Rr.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let n=[];for(let s=0,r=t.length;s<r;s++){let a=t[s];n.push(a.x,a.y,a.z||0)}this.setAttribute("position",new dn(n,3))}else{let n=Math.min(t.length,e.count);for(let s=0;s<n;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&Ut("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Hi);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Ht("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new B(-1/0,-1/0,-1/0),new B(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){let r=e[n];Xn.setFromBufferAttribute(r),this.morphTargetsRelative?(ln.addVectors(this.boundingBox.min,Xn.min),this.boundingBox.expandByPoint(ln),ln.addVectors(this.boundingBox.max,Xn.max),this.boundingBox.expandByPoint(ln)):(this.boundingBox.expandByPoint(Xn.min),this.boundingBox.expandByPoint(Xn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Ht('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Wi);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Ht("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new B,1/0);return}if(t){let n=this.boundingSphere.center;if(Xn.setFromBufferAttribute(t),e)for(let r=0,a=e.length;r<a;r++){let o=e[r];Ia.setFromBufferAttribute(o),this.morphTargetsRelative?(ln.addVectors(Xn.min,Ia.min),Xn.expandByPoint(ln),ln.addVectors(Xn.max,Ia.max),Xn.expandByPoint(ln)):(Xn.expandByPoint(Ia.min),Xn.expandByPoint(Ia.max))}Xn.getCenter(n);let s=0;for(let r=0,a=t.count;r<a;r++)ln.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(ln));if(e)for(let r=0,a=e.length;r<a;r++){let o=e[r],l=this.morphTargetsRelative;for(let c=0,h=o.count;c<h;c++)ln.fromBufferAttribute(o,c),l&&(Rr.fromBufferAttribute(t,c),ln.add(Rr)),s=Math.max(s,n.distanceToSquared(ln))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Ht('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Ht("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,s=e.normal,r=e.uv,a=this.getAttribute("tangent");(a===void 0||a.count!==n.count)&&(a=new cn(new Float32Array(4*n.count),4),this.setAttribute("tangent",a));let o=[],l=[],c=new Uint8Array(n.count);for(let F=0;F<n.count;F++)o[F]=new B,l[F]=new B;let h=new B,u=new B,f=new B,d=new zt,m=new zt,_=new zt,p=new B,g=new B;function y(F,L,O){c[F]=c[L]=c[O]=1,h.fromBufferAttribute(n,F),u.fromBufferAttribute(n,L),f.fromBufferAttribute(n,O),d.fromBufferAttribute(r,F),m.fromBufferAttribute(r,L),_.fromBufferAttribute(r,O),u.sub(h),f.sub(h),m.sub(d),_.sub(d);let H=1/(m.x*_.y-_.x*m.y);isFinite(H)&&(p.copy(u).multiplyScalar(_.y).addScaledVector(f,-m.y).multiplyScalar(H),g.copy(f).multiplyScalar(m.x).addScaledVector(u,-_.x).multiplyScalar(H),o[F].add(p),o[L].add(p),o[O].add(p),l[F].add(g),l[L].add(g),l[O].add(g))}let w=this.groups;w.length===0&&(w=[{start:0,count:t.count}]);for(let F=0,L=w.length;F<L;++F){let O=w[F],H=O.start,Z=O.count;for(let P=H,W=H+Z;P<W;P+=3)y(t.getX(P+0),t.getX(P+1),t.getX(P+2))}let b=new B,E=new B,T=new B,x=new B;function A(F){T.fromBufferAttribute(s,F),x.copy(T);let L=o[F];b.copy(L),b.sub(T.multiplyScalar(T.dot(L))).normalize(),E.crossVectors(x,L);let H=E.dot(l[F])<0?-1:1;a.setXYZW(F,b.x,b.y,b.z,H)}for(let F=0,L=n.count;F<L;++F)c[F]&&A(F);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==e.count)n=new cn(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let f=0,d=n.count;f<d;f++)n.setXYZ(f,0,0,0);let s=new B,r=new B,a=new B,o=new B,l=new B,c=new B,h=new B,u=new B;if(t)for(let f=0,d=t.count;f<d;f+=3){let m=t.getX(f+0),_=t.getX(f+1),p=t.getX(f+2);s.fromBufferAttribute(e,m),r.fromBufferAttribute(e,_),a.fromBufferAttribute(e,p),h.subVectors(a,r),u.subVectors(s,r),h.cross(u),o.fromBufferAttribute(n,m),l.fromBufferAttribute(n,_),c.fromBufferAttribute(n,p),o.add(h),l.add(h),c.add(h),n.setXYZ(m,o.x,o.y,o.z),n.setXYZ(_,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let f=0,d=e.count;f<d;f+=3)s.fromBufferAttribute(e,f+0),r.fromBufferAttribute(e,f+1),a.fromBufferAttribute(e,f+2),h.subVectors(a,r),u.subVectors(s,r),h.cross(u),n.setXYZ(f+0,h.x,h.y,h.z),n.setXYZ(f+1,h.x,h.y,h.z),n.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)ln.fromBufferAttribute(t,e),ln.normalize(),t.setXYZ(e,ln.x,ln.y,ln.z)}toNonIndexed(){function t(o,l){let c=o.array,h=o.itemSize,u=o.normalized,f=new c.constructor(l.length*h),d=0,m=0;for(let _=0,p=l.length;_<p;_++){o.isInterleavedBufferAttribute?d=l[_]*o.data.stride+o.offset:d=l[_]*h;for(let g=0;g<h;g++)f[m++]=c[d++]}return new cn(f,h,u)}if(this.index===null)return Ut("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new i,n=this.index.array,s=this.attributes;for(let o in s){let l=s[o],c=t(l,n);e.setAttribute(o,c)}let r=this.morphAttributes;for(let o in r){let l=[],c=r[o];for(let h=0,u=c.length;h<u;h++){let f=c[h],d=t(f,n);l.push(d)}e.morphAttributes[o]=l}e.morphTargetsRelative=this.morphTargetsRelative;let a=this.groups;for(let o=0,l=a.length;o<l;o++){let c=a[o];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,f=c.length;u<f;u++){let d=c[u];h.push(d.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let a=this.groups;a.length>0&&(t.data.groups=JSON.parse(JSON.stringify(a)));let o=this.boundingSphere;return o!==null&&(t.data.boundingSphere=o.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone());let s=t.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let f=0,d=u.length;f<d;f++)h.push(u[f].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let a=t.groups;for(let c=0,h=a.length;c<h;c++){let u=a[c];this.addGroup(u.start,u.count,u.materialIndex)}let o=t.boundingBox;o!==null&&(this.boundingBox=o.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var gf=new B,QM=new B,tb=new $t,Tn=class{constructor(t=new B(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let s=gf.subVectors(n,e).cross(QM.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,n=!0){let s=t.delta(gf),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let a=-(t.start.dot(this.normal)+this.constant)/r;return n===!0&&(a<0||a>1)?null:e.copy(t.start).addScaledVector(s,a)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||tb.getNormalMatrix(t),s=this.coplanarPoint(gf).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},eb=0,wi=class extends di{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:eb++}),this.uuid=qs(),this.name="",this.type="Material",this.blending=qr,this.side=_s,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Uf,this.blendDst=Ff,this.blendEquation=Ws,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Jt(0,0,0),this.blendAlpha=0,this.depthFunc=Nr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=C0,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Hl,this.stencilZFail=Hl,this.stencilZPass=Hl,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){Ut(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Ut(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let a=[];for(let o in r){let l=r[o];delete l.metadata,a.push(l)}return a}if(e){let r=s(t.textures),a=s(t.images);r.length>0&&(n.textures=r),a.length>0&&(n.images=a)}return n}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Jt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(n=>new Tn().fromJSON(n))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let n=t.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new zt().fromArray(n)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new zt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var ki=new B,_f=new B,Al=new B,Tl=new B,Xi=class{constructor(t=new B,e=new B(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,ki)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=ki.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(ki.copy(this.origin).addScaledVector(this.direction,e),ki.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){_f.copy(t).add(e).multiplyScalar(.5),Al.copy(e).sub(t).normalize(),Tl.copy(this.origin).sub(_f);let r=t.distanceTo(e)*.5,a=-this.direction.dot(Al),o=Tl.dot(this.direction),l=-Tl.dot(Al),c=Tl.lengthSq(),h=Math.abs(1-a*a),u,f,d,m;if(h>0)if(u=a*l-o,f=a*o-l,m=r*h,u>=0)if(f>=-m)if(f<=m){let _=1/h;u*=_,f*=_,d=u*(u+a*f+2*o)+f*(a*u+f+2*l)+c}else f=r,u=Math.max(0,-(a*f+o)),d=-u*u+f*(f+2*l)+c;else f=-r,u=Math.max(0,-(a*f+o)),d=-u*u+f*(f+2*l)+c;else f<=-m?(u=Math.max(0,-(-a*r+o)),f=u>0?-r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c):f<=m?(u=0,f=Math.min(Math.max(-r,-l),r),d=f*(f+2*l)+c):(u=Math.max(0,-(a*r+o)),f=u>0?r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c);else f=a>0?-r:r,u=Math.max(0,-(a*f+o)),d=-u*u+f*(f+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(_f).addScaledVector(Al,f),d}intersectSphere(t,e){if(t.radius<0)return null;ki.subVectors(t.center,this.origin);let n=ki.dot(this.direction),s=ki.dot(ki)-n*n,r=t.radius*t.radius;if(s>r)return null;let a=Math.sqrt(r-s),o=n-a,l=n+a;return l<0?null:o<0?this.at(l,e):this.at(o,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,a,o,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return c>=0?(n=(t.min.x-f.x)*c,s=(t.max.x-f.x)*c):(n=(t.max.x-f.x)*c,s=(t.min.x-f.x)*c),h>=0?(r=(t.min.y-f.y)*h,a=(t.max.y-f.y)*h):(r=(t.max.y-f.y)*h,a=(t.min.y-f.y)*h),n>a||r>s||((r>n||isNaN(n))&&(n=r),(a<s||isNaN(s))&&(s=a),u>=0?(o=(t.min.z-f.z)*u,l=(t.max.z-f.z)*u):(o=(t.max.z-f.z)*u,l=(t.min.z-f.z)*u),n>l||o>s)||((o>n||n!==n)&&(n=o),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,ki)!==null}intersectTriangle(t,e,n,s,r){let a=this.origin,o=this.direction,l=o.x,c=o.y,h=o.z,u=t.x-a.x,f=t.y-a.y,d=t.z-a.z,m=e.x-a.x,_=e.y-a.y,p=e.z-a.z,g=n.x-a.x,y=n.y-a.y,w=n.z-a.z,b=Math.abs(l),E=Math.abs(c),T=Math.abs(h),x,A,F,L,O,H,Z,P,W,tt,$,at;if(b>=E&&b>=T?(F=l,H=u,W=m,at=g,l>=0?(x=c,A=h,L=f,O=d,Z=_,P=p,tt=y,$=w):(x=h,A=c,L=d,O=f,Z=p,P=_,tt=w,$=y)):E>=T?(F=c,H=f,W=_,at=y,c>=0?(x=h,A=l,L=d,O=u,Z=p,P=m,tt=w,$=g):(x=l,A=h,L=u,O=d,Z=m,P=p,tt=g,$=w)):(F=h,H=d,W=p,at=w,h>=0?(x=l,A=c,L=u,O=f,Z=m,P=_,tt=g,$=y):(x=c,A=l,L=f,O=u,Z=_,P=m,tt=y,$=g)),F===0)return null;let X=x/F,k=A/F,it=1/F,Tt=L-X*H,kt=O-k*H,et=Z-X*W,pt=P-k*W,_t=tt-X*at,Nt=$-k*at,lt=_t*pt-Nt*et,At=Tt*Nt-kt*_t,ae=et*kt-pt*Tt;if(s){if(lt<0||At<0||ae<0)return null}else if((lt<0||At<0||ae<0)&&(lt>0||At>0||ae>0))return null;let Ft=lt+At+ae;if(Ft===0)return null;let ee=it*(lt*H+At*W+ae*at);return(Ft>0?ee<0:ee>0)?null:this.at(ee/Ft,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},zr=class extends wi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Jt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Vi,this.combine=Mc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Dg=new re,Fs=new Xi,Rl=new Wi,Og=new B,Cl=new B,Pl=new B,Il=new B,yf=new B,Ll=new B,Ug=new B,Nl=new B,On=class extends un{constructor(t=new Pn,e=new zr){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}getVertexPosition(t,e){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,a=n.morphTargetsRelative;e.fromBufferAttribute(s,t);let o=this.morphTargetInfluences;if(r&&o){Ll.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=o[l],u=r[l];h!==0&&(yf.fromBufferAttribute(u,t),a?Ll.addScaledVector(yf,h):Ll.addScaledVector(yf.sub(e),h))}e.add(Ll)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Rl.copy(n.boundingSphere),Rl.applyMatrix4(r),Fs.copy(t.ray).recast(t.near),!(Rl.containsPoint(Fs.origin)===!1&&(Fs.intersectSphere(Rl,Og)===null||Fs.origin.distanceToSquared(Og)>(t.far-t.near)**2))&&(Dg.copy(r).invert(),Fs.copy(t.ray).applyMatrix4(Dg),!(n.boundingBox!==null&&Fs.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,Fs)))}_computeIntersections(t,e,n){let s,r=this.geometry,a=this.material,o=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,d=r.drawRange;if(o!==null)if(Array.isArray(a))for(let m=0,_=f.length;m<_;m++){let p=f[m],g=a[p.materialIndex],y=Math.max(p.start,d.start),w=Math.min(o.count,Math.min(p.start+p.count,d.start+d.count));for(let b=y,E=w;b<E;b+=3){let T=o.getX(b),x=o.getX(b+1),A=o.getX(b+2);s=Dl(this,g,t,n,c,h,u,T,x,A),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,d.start),_=Math.min(o.count,d.start+d.count);for(let p=m,g=_;p<g;p+=3){let y=o.getX(p),w=o.getX(p+1),b=o.getX(p+2);s=Dl(this,a,t,n,c,h,u,y,w,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(a))for(let m=0,_=f.length;m<_;m++){let p=f[m],g=a[p.materialIndex],y=Math.max(p.start,d.start),w=Math.min(l.count,Math.min(p.start+p.count,d.start+d.count));for(let b=y,E=w;b<E;b+=3){let T=b,x=b+1,A=b+2;s=Dl(this,g,t,n,c,h,u,T,x,A),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,d.start),_=Math.min(l.count,d.start+d.count);for(let p=m,g=_;p<g;p+=3){let y=p,w=p+1,b=p+2;s=Dl(this,a,t,n,c,h,u,y,w,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}};function nb(i,t,e,n,s,r,a,o){let l;if(t.side===In?l=n.intersectTriangle(a,r,s,!0,o):l=n.intersectTriangle(s,r,a,t.side===_s,o),l===null)return null;Nl.copy(o),Nl.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(Nl);return c<e.near||c>e.far?null:{distance:c,point:Nl.clone(),object:i}}function Dl(i,t,e,n,s,r,a,o,l,c){i.getVertexPosition(o,Cl),i.getVertexPosition(l,Pl),i.getVertexPosition(c,Il);let h=nb(i,t,e,n,Cl,Pl,Il,Ug);if(h){let u=new B;cs.getBarycoord(Ug,Cl,Pl,Il,u),s&&(h.uv=cs.getInterpolatedAttribute(s,o,l,c,u,new zt)),r&&(h.uv1=cs.getInterpolatedAttribute(r,o,l,c,u,new zt)),a&&(h.normal=cs.getInterpolatedAttribute(a,o,l,c,u,new B),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let f={a:o,b:l,c,normal:new B,materialIndex:0};cs.getNormal(Cl,Pl,Il,f.normal),h.face=f,h.barycoord=u}return h}var La=new be,Fg=new be,Bg=new be,ib=new be,kg=new re,Ol=new B,xf=new Wi,zg=new re,vf=new Xi,$a=class extends On{constructor(t,e){super(t,e),this.isSkinnedMesh=!0,this.type="SkinnedMesh",this.bindMode=wf,this.bindMatrix=new re,this.bindMatrixInverse=new re,this.boundingBox=null,this.boundingSphere=null}computeBoundingBox(){let t=this.geometry;this.boundingBox===null&&(this.boundingBox=new Hi),this.boundingBox.makeEmpty();let e=t.getAttribute("position");for(let n=0;n<e.count;n++)this.getVertexPosition(n,Ol),this.boundingBox.expandByPoint(Ol)}computeBoundingSphere(){let t=this.geometry;this.boundingSphere===null&&(this.boundingSphere=new Wi),this.boundingSphere.makeEmpty();let e=t.getAttribute("position");for(let n=0;n<e.count;n++)this.getVertexPosition(n,Ol),this.boundingSphere.expandByPoint(Ol)}copy(t,e){return super.copy(t,e),this.bindMode=t.bindMode,this.bindMatrix.copy(t.bindMatrix),this.bindMatrixInverse.copy(t.bindMatrixInverse),this.skeleton=t.skeleton,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}raycast(t,e){let n=this.material,s=this.matrixWorld;n!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),xf.copy(this.boundingSphere),xf.applyMatrix4(s),t.ray.intersectsSphere(xf)!==!1&&(zg.copy(s).invert(),vf.copy(t.ray).applyMatrix4(zg),!(this.boundingBox!==null&&vf.intersectsBox(this.boundingBox)===!1)&&this._computeIntersections(t,e,vf)))}getVertexPosition(t,e){return super.getVertexPosition(t,e),this.applyBoneTransform(t,e),e}bind(t,e){this.skeleton=t,e===void 0&&(this.updateMatrixWorld(!0),this.skeleton.calculateInverses(),e=this.matrixWorld),this.bindMatrix.copy(e),this.bindMatrixInverse.copy(e).invert()}pose(){this.skeleton.pose()}normalizeSkinWeights(){let t=new be,e=this.geometry.attributes.skinWeight;for(let n=0,s=e.count;n<s;n++){t.fromBufferAttribute(e,n);let r=1/t.manhattanLength();r!==1/0?t.multiplyScalar(r):t.set(1,0,0,0),e.setXYZW(n,t.x,t.y,t.z,t.w)}}updateMatrixWorld(t){super.updateMatrixWorld(t),this.bindMode===wf?this.bindMatrixInverse.copy(this.matrixWorld).invert():this.bindMode===E0?this.bindMatrixInverse.copy(this.bindMatrix).invert():Ut("SkinnedMesh: Unrecognized bindMode: "+this.bindMode)}applyBoneTransform(t,e){let n=this.skeleton,s=this.geometry;Fg.fromBufferAttribute(s.attributes.skinIndex,t),Bg.fromBufferAttribute(s.attributes.skinWeight,t),e.isVector4?(La.copy(e),e.set(0,0,0,0)):(La.set(e.x,e.y,e.z,1),e.set(0,0,0)),La.applyMatrix4(this.bindMatrix);for(let r=0;r<4;r++){let a=Bg.getComponent(r);if(a!==0){let o=Fg.getComponent(r);kg.multiplyMatrices(n.bones[o].matrixWorld,n.boneInverses[o]),e.addScaledVector(ib.copy(La).applyMatrix4(kg),a)}}return e.isVector4&&(e.w=La.w),e.applyMatrix4(this.bindMatrixInverse)}},Gr=class extends un{constructor(){super(),this.isBone=!0,this.type="Bone"}},qa=class extends Dn{constructor(t=null,e=1,n=1,s,r,a,o,l,c=hn,h=hn,u,f){super(null,a,o,l,c,h,s,r,u,f),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}},Gg=new re,sb=new re,Ya=class i{constructor(t=[],e=[]){this.uuid=qs(),this.bones=t.slice(0),this.boneInverses=e,this.boneMatrices=null,this.previousBoneMatrices=null,this.boneTexture=null,this.previousBoneTexture=null,this.init()}init(){let t=this.bones,e=this.boneInverses;if(this.boneMatrices=new Float32Array(t.length*16),e.length===0)this.calculateInverses();else if(t.length!==e.length){Ut("Skeleton: Number of inverse bone matrices does not match amount of bones."),this.boneInverses=[];for(let n=0,s=this.bones.length;n<s;n++)this.boneInverses.push(new re)}}calculateInverses(){this.boneInverses.length=0;for(let t=0,e=this.bones.length;t<e;t++){let n=new re;this.bones[t]&&n.copy(this.bones[t].matrixWorld).invert(),this.boneInverses.push(n)}}pose(){for(let t=0,e=this.bones.length;t<e;t++){let n=this.bones[t];n&&n.matrixWorld.copy(this.boneInverses[t]).invert()}for(let t=0,e=this.bones.length;t<e;t++){let n=this.bones[t];n&&(n.parent&&n.parent.isBone?(n.matrix.copy(n.parent.matrixWorld).invert(),n.matrix.multiply(n.matrixWorld)):n.matrix.copy(n.matrixWorld),n.matrix.decompose(n.position,n.quaternion,n.scale))}}update(){let t=this.bones,e=this.boneInverses,n=this.boneMatrices,s=this.boneTexture;for(let r=0,a=t.length;r<a;r++){let o=t[r]?t[r].matrixWorld:sb;Gg.multiplyMatrices(o,e[r]),Gg.toArray(n,r*16)}s!==null&&(s.needsUpdate=!0)}clone(){return new i(this.bones,this.boneInverses)}computeBoneTexture(){let t=Math.sqrt(this.bones.length*4);t=Math.ceil(t/4)*4,t=Math.max(t,4);let e=new Float32Array(t*t*4);e.set(this.boneMatrices);let n=new qa(e,t,t,ri,si);return n.needsUpdate=!0,this.boneMatrices=e,this.boneTexture=n,this}getBoneByName(t){for(let e=0,n=this.bones.length;e<n;e++){let s=this.bones[e];if(s.name===t)return s}}dispose(){this.boneTexture!==null&&(this.boneTexture.dispose(),this.boneTexture=null),this.previousBoneTexture!==null&&(this.previousBoneTexture.dispose(),this.previousBoneTexture=null)}fromJSON(t,e){this.uuid=t.uuid;for(let n=0,s=t.bones.length;n<s;n++){let r=t.bones[n],a=e[r];a===void 0&&(Ut("Skeleton: No bone found with UUID:",r),a=new Gr),this.bones.push(a),this.boneInverses.push(new re().fromArray(t.boneInverses[n]))}return this.init(),this}toJSON(){let t={metadata:{version:4.7,type:"Skeleton",generator:"Skeleton.toJSON"},bones:[],boneInverses:[]};t.uuid=this.uuid;let e=this.bones,n=this.boneInverses;for(let s=0,r=e.length;s<r;s++){let a=e[s];t.bones.push(a.uuid);let o=n[s];t.boneInverses.push(o.toArray())}return t}};var Bs=new Wi,rb=new zt(.5,.5),Ul=new B,hs=class{constructor(t=new Tn,e=new Tn,n=new Tn,s=new Tn,r=new Tn,a=new Tn){this.planes=[t,e,n,s,r,a]}set(t,e,n,s,r,a){let o=this.planes;return o[0].copy(t),o[1].copy(e),o[2].copy(n),o[3].copy(s),o[4].copy(r),o[5].copy(a),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=ii,n=!1){let s=this.planes,r=t.elements,a=r[0],o=r[1],l=r[2],c=r[3],h=r[4],u=r[5],f=r[6],d=r[7],m=r[8],_=r[9],p=r[10],g=r[11],y=r[12],w=r[13],b=r[14],E=r[15];if(s[0].setComponents(c-a,d-h,g-m,E-y).normalize(),s[1].setComponents(c+a,d+h,g+m,E+y).normalize(),s[2].setComponents(c+o,d+u,g+_,E+w).normalize(),s[3].setComponents(c-o,d-u,g-_,E-w).normalize(),n)s[4].setComponents(l,f,p,b).normalize(),s[5].setComponents(c-l,d-f,g-p,E-b).normalize();else if(s[4].setComponents(c-l,d-f,g-p,E-b).normalize(),e===ii)s[5].setComponents(c+l,d+f,g+p,E+b).normalize();else if(e===Dr)s[5].setComponents(l,f,p,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Bs.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),Bs.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Bs)}intersectsSprite(t){Bs.center.set(0,0,0);let e=rb.distanceTo(t.center);return Bs.radius=.7071067811865476+e,Bs.applyMatrix4(t.matrixWorld),this.intersectsSphere(Bs)}intersectsSphere(t){let e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let s=e[n];if(Ul.x=s.normal.x>0?t.max.x:t.min.x,Ul.y=s.normal.y>0?t.max.y:t.min.y,Ul.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(Ul)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Vg=new re,ic=class i{constructor(){this.coordinateSystem=ii,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,n=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];Vg.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new hs),n[s].setFromProjectionMatrix(Vg,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,n=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new hs),e[s].copy(n[s]);return this._count=t._count,this}clone(){return new i().copy(this)}};var zs=class extends wi{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Jt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},sc=new B,rc=new B,Hg=new re,Na=new Xi,Fl=new Wi,Mf=new B,Wg=new B,Vr=class extends un{constructor(t=new Pn,e=new zs){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)sc.fromBufferAttribute(e,s-1),rc.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=sc.distanceTo(rc);t.setAttribute("lineDistance",new dn(n,1))}else Ut("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,a=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Fl.copy(n.boundingSphere),Fl.applyMatrix4(s),Fl.radius+=r,t.ray.intersectsSphere(Fl)===!1)return;Hg.copy(s).invert(),Na.copy(t.ray).applyMatrix4(Hg);let o=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=o*o,c=this.isLineSegments?2:1,h=n.index,f=n.attributes.position;if(h!==null){let d=Math.max(0,a.start),m=Math.min(h.count,a.start+a.count);for(let _=d,p=m-1;_<p;_+=c){let g=h.getX(_),y=h.getX(_+1),w=Bl(this,t,Na,l,g,y,_);w&&e.push(w)}if(this.isLineLoop){let _=h.getX(m-1),p=h.getX(d),g=Bl(this,t,Na,l,_,p,m-1);g&&e.push(g)}}else{let d=Math.max(0,a.start),m=Math.min(f.count,a.start+a.count);for(let _=d,p=m-1;_<p;_+=c){let g=Bl(this,t,Na,l,_,_+1,_);g&&e.push(g)}if(this.isLineLoop){let _=Bl(this,t,Na,l,m-1,d,m-1);_&&e.push(_)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}};function Bl(i,t,e,n,s,r,a){let o=i.geometry.attributes.position;if(sc.fromBufferAttribute(o,s),rc.fromBufferAttribute(o,r),e.distanceSqToSegment(sc,rc,Mf,Wg)>n)return;Mf.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(Mf);if(!(c<t.near||c>t.far))return{distance:c,point:Wg.clone().applyMatrix4(i.matrixWorld),index:a,face:null,faceIndex:null,barycoord:null,object:i}}var Xg=new B,$g=new B,Za=class extends Vr{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)Xg.fromBufferAttribute(e,s),$g.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+Xg.distanceTo($g);t.setAttribute("lineDistance",new dn(n,1))}else Ut("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Ja=class extends Dn{constructor(t=[],e=Xs,n,s,r,a,o,l,c,h){super(t,e,n,s,r,a,o,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var $i=class extends Dn{constructor(t,e,n=pi,s,r,a,o=hn,l=hn,c,h=Gi,u=1){if(h!==Gi&&h!==Yi)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:t,height:e,depth:u};super(f,s,r,a,o,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new Fr(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Ka=class extends $i{constructor(t,e=pi,n=Xs,s,r,a=hn,o=hn,l,c=Gi){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,n,s,r,a,o,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},ja=class extends Dn{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Hr=class i extends Pn{constructor(t=1,e=1,n=1,s=1,r=1,a=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:a};let o=this;s=Math.floor(s),r=Math.floor(r),a=Math.floor(a);let l=[],c=[],h=[],u=[],f=0,d=0;m("z","y","x",-1,-1,n,e,t,a,r,0),m("z","y","x",1,-1,n,e,-t,a,r,1),m("x","z","y",1,1,t,n,e,s,a,2),m("x","z","y",1,-1,t,n,-e,s,a,3),m("x","y","z",1,-1,t,e,n,s,r,4),m("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new dn(c,3)),this.setAttribute("normal",new dn(h,3)),this.setAttribute("uv",new dn(u,2));function m(_,p,g,y,w,b,E,T,x,A,F){let L=b/x,O=E/A,H=b/2,Z=E/2,P=T/2,W=x+1,tt=A+1,$=0,at=0,X=new B;for(let k=0;k<tt;k++){let it=k*O-Z;for(let Tt=0;Tt<W;Tt++){let kt=Tt*L-H;X[_]=kt*y,X[p]=it*w,X[g]=P,c.push(X.x,X.y,X.z),X[_]=0,X[p]=0,X[g]=T>0?1:-1,h.push(X.x,X.y,X.z),u.push(Tt/x),u.push(1-k/A),$+=1}}for(let k=0;k<A;k++)for(let it=0;it<x;it++){let Tt=f+it+W*k,kt=f+it+W*(k+1),et=f+(it+1)+W*(k+1),pt=f+(it+1)+W*k;l.push(Tt,kt,pt),l.push(kt,et,pt),at+=6}o.addGroup(d,at,F),d+=at,f+=$}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Gs=class i extends Pn{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};let r=t/2,a=e/2,o=Math.floor(n),l=Math.floor(s),c=o+1,h=l+1,u=t/o,f=e/l,d=[],m=[],_=[],p=[];for(let g=0;g<h;g++){let y=g*f-a;for(let w=0;w<c;w++){let b=w*u-r;m.push(b,-y,0),_.push(0,0,1),p.push(w/o),p.push(1-g/l)}}for(let g=0;g<l;g++)for(let y=0;y<o;y++){let w=y+c*g,b=y+c*(g+1),E=y+1+c*(g+1),T=y+1+c*g;d.push(w,b,T),d.push(b,E,T)}this.setIndex(d),this.setAttribute("position",new dn(m,3)),this.setAttribute("normal",new dn(_,3)),this.setAttribute("uv",new dn(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.widthSegments,t.heightSegments)}},Qa=class i extends Pn{constructor(t=.5,e=1,n=32,s=1,r=0,a=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:n,phiSegments:s,thetaStart:r,thetaLength:a},n=Math.max(3,n),s=Math.max(1,s);let o=[],l=[],c=[],h=[],u=t,f=(e-t)/s,d=new B,m=new zt;for(let _=0;_<=s;_++){for(let p=0;p<=n;p++){let g=r+p/n*a;d.x=u*Math.cos(g),d.y=u*Math.sin(g),l.push(d.x,d.y,d.z),c.push(0,0,1),m.x=(d.x/e+1)/2,m.y=(d.y/e+1)/2,h.push(m.x,m.y)}u+=f}for(let _=0;_<s;_++){let p=_*(n+1);for(let g=0;g<n;g++){let y=g+p,w=y,b=y+n+1,E=y+n+2,T=y+1;o.push(w,b,T),o.push(b,E,T)}}this.setIndex(o),this.setAttribute("position",new dn(l,3)),this.setAttribute("normal",new dn(c,3)),this.setAttribute("uv",new dn(h,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}};var to=class extends wi{constructor(t){super(),this.isShadowMaterial=!0,this.type="ShadowMaterial",this.color=new Jt(0),this.transparent=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.fog=t.fog,this}};function Ys(i){let t={};for(let e in i){t[e]={};for(let n in i[e]){let s=i[e][n];if(qg(s))s.isRenderTargetTexture?(Ut("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone();else if(Array.isArray(s))if(qg(s[0])){let r=[];for(let a=0,o=s.length;a<o;a++)r[a]=s[a].clone();t[e][n]=r}else t[e][n]=s.slice();else t[e][n]=s}}return t}function vn(i){let t={};for(let e=0;e<i.length;e++){let n=Ys(i[e]);for(let s in n)t[s]=n[s]}return t}function qg(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function ab(i){let t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function ld(i){let t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:ce.workingColorSpace}var H0={clone:Ys,merge:vn},ob=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,lb=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Si=class extends wi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=ob,this.fragmentShader=lb,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Ys(t.uniforms),this.uniformsGroups=ab(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let a=this.uniforms[s].value;a&&a.isTexture?e.uniforms[s]={type:"t",value:a.toJSON(t).uuid}:a&&a.isColor?e.uniforms[s]={type:"c",value:a.getHex()}:a&&a.isVector2?e.uniforms[s]={type:"v2",value:a.toArray()}:a&&a.isVector3?e.uniforms[s]={type:"v3",value:a.toArray()}:a&&a.isVector4?e.uniforms[s]={type:"v4",value:a.toArray()}:a&&a.isMatrix3?e.uniforms[s]={type:"m3",value:a.toArray()}:a&&a.isMatrix4?e.uniforms[s]={type:"m4",value:a.toArray()}:e.uniforms[s]={value:a}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let n in t.uniforms){let s=t.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=e[s.value]||null;break;case"c":this.uniforms[n].value=new Jt().setHex(s.value);break;case"v2":this.uniforms[n].value=new zt().fromArray(s.value);break;case"v3":this.uniforms[n].value=new B().fromArray(s.value);break;case"v4":this.uniforms[n].value=new be().fromArray(s.value);break;case"m3":this.uniforms[n].value=new $t().fromArray(s.value);break;case"m4":this.uniforms[n].value=new re().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let n in t.extensions)this.extensions[n]=t.extensions[n];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},ac=class extends Si{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var eo=class extends wi{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Jt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Jt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=oh,this.normalScale=new zt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Vi,this.combine=Mc,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},oc=class extends wi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=T0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},lc=class extends wi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function Cr(i,t){return!i||i.constructor===t?i:typeof t.BYTES_PER_ELEMENT=="number"?new t(i):Array.prototype.slice.call(i)}function kl(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var us=class{constructor(t,e,n,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,s=e[n],r=e[n-1];t:{e:{let a;n:{i:if(!(t<s)){for(let o=n+2;;){if(s===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===o)break;if(r=s,s=e[++n],t<s)break e}a=e.length;break n}if(!(t>=r)){let o=e[1];t<o&&(n=2,r=o);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=e[--n-1],t>=r)break e}a=n,n=0;break n}break t}for(;n<a;){let o=n+a>>>1;t<e[o]?a=o:n=o+1}if(s=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=t*s;for(let a=0;a!==s;++a)e[a]=n[r+a];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},cc=class extends us{constructor(t,e,n,s){super(t,e,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Ef,endingEnd:Ef}}intervalChanged_(t,e,n){let s=this.parameterPositions,r=t-2,a=t+1,o=s[r],l=s[a];if(o===void 0)switch(this.getSettings_().endingStart){case Af:r=t,o=2*e-n;break;case Tf:r=s.length-2,o=e+s[r]-s[r+1];break;default:r=t,o=n}if(l===void 0)switch(this.getSettings_().endingEnd){case Af:a=t,l=2*n-e;break;case Tf:a=1,l=n+s[1]-s[0];break;default:a=t-1,l=e}let c=(n-e)*.5,h=this.valueSize;this._weightPrev=c/(e-o),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=a*h}interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=this._offsetPrev,u=this._offsetNext,f=this._weightPrev,d=this._weightNext,m=(n-e)/(s-e),_=m*m,p=_*m,g=-f*p+2*f*_-f*m,y=(1+f)*p+(-1.5-2*f)*_+(-.5+f)*m+1,w=(-1-d)*p+(1.5+d)*_+.5*m,b=d*p-d*_;for(let E=0;E!==o;++E)r[E]=g*a[h+E]+y*a[c+E]+w*a[l+E]+b*a[u+E];return r}},hc=class extends us{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=(n-e)/(s-e),u=1-h;for(let f=0;f!==o;++f)r[f]=a[c+f]*u+a[l+f]*h;return r}},uc=class extends us{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t){return this.copySampleValue_(t-1)}},fc=class extends us{interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=t*o,c=l-o,h=this.inTangents,u=this.outTangents;if(!h||!u){let m=(n-e)/(s-e),_=1-m;for(let p=0;p!==o;++p)r[p]=a[c+p]*_+a[l+p]*m;return r}let f=o*2,d=t-1;for(let m=0;m!==o;++m){let _=a[c+m],p=a[l+m],g=d*f+m*2,y=u[g],w=u[g+1],b=t*f+m*2,E=h[b],T=h[b+1],x=hb(n,e,y,E,s);r[m]=W0(x,_,w,T,p)}return r}};function W0(i,t,e,n,s){let r=1-i;return r*r*r*t+3*r*r*i*e+3*r*i*i*n+i*i*i*s}function cb(i,t,e,n,s){let r=1-i;return 3*r*r*(e-t)+6*r*i*(n-e)+3*i*i*(s-n)}function hb(i,t,e,n,s){let r=(i-t)/(s-t);for(let a=0;a<8;a++){let o=W0(r,t,e,n,s)-i;if(Math.abs(o)<1e-10)break;let l=cb(r,t,e,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-o/l))}return r}var qn=class{constructor(t,e,n,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=Cr(e,this.TimeBufferType),this.values=Cr(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:Cr(t.times,Array),values:Cr(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(n.interpolation=s),kl(t.settings)&&(n.settings={inTangents:Cr(t.settings.inTangents,Array),outTangents:Cr(t.settings.outTangents,Array)})}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new uc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new hc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new cc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new fc(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case Fa:e=this.InterpolantFactoryMethodDiscrete;break;case Ql:e=this.InterpolantFactoryMethodLinear;break;case Vl:e=this.InterpolantFactoryMethodSmooth;break;case Sf:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Ut("KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Fa;case this.InterpolantFactoryMethodLinear:return Ql;case this.InterpolantFactoryMethodSmooth:return Vl;case this.InterpolantFactoryMethodBezier:return Sf}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]+=t;kl(this.settings)&&(Yg(this.settings.inTangents,t),Yg(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]*=t;kl(this.settings)&&(Zg(this.settings.inTangents,t),Zg(this.settings.outTangents,t))}return this}trim(t,e){let n=this.times,s=n.length,r=0,a=s-1;for(;r!==s&&n[r]<t;)++r;for(;a!==-1&&n[a]>e;)--a;if(++a,r!==0||a!==s){r>=a&&(a=Math.max(a,1),r=a-1);let o=this.getValueSize();this.times=n.slice(r,a),this.values=this.values.slice(r*o,a*o)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Ht("KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,s=this.values,r=n.length;r===0&&(Ht("KeyframeTrack: Track is empty.",this),t=!1);let a=null;for(let o=0;o!==r;o++){let l=n[o];if(typeof l=="number"&&isNaN(l)){Ht("KeyframeTrack: Time is not a valid number.",this,o,l),t=!1;break}if(a!==null&&a>l){Ht("KeyframeTrack: Out of order keys.",this,o,l,a),t=!1;break}a=l}if(s!==void 0&&SM(s))for(let o=0,l=s.length;o!==l;++o){let c=s[o];if(isNaN(c)){Ht("KeyframeTrack: Value is not a valid number.",this,o,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Vl,r=t.length-1,a=1;for(let o=1;o<r;++o){let l=!1,c=t[o],h=t[o+1];if(c!==h&&(o!==1||c!==t[0]))if(s)l=!0;else{let u=o*n,f=u-n,d=u+n;for(let m=0;m!==n;++m){let _=e[u+m];if(_!==e[f+m]||_!==e[d+m]){l=!0;break}}}if(l){if(o!==a){t[a]=t[o];let u=o*n,f=a*n;for(let d=0;d!==n;++d)e[f+d]=e[u+d]}++a}}if(r>0){t[a]=t[r];for(let o=r*n,l=a*n,c=0;c!==n;++c)e[l+c]=e[o+c];++a}return a!==t.length?(this.times=t.slice(0,a),this.values=e.slice(0,a*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,s=new n(this.name,t,e);return s.createInterpolant=this.createInterpolant,kl(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Yg(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]+=t}function Zg(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]*=t}qn.prototype.ValueTypeName="";qn.prototype.TimeBufferType=Float32Array;qn.prototype.ValueBufferType=Float32Array;qn.prototype.DefaultInterpolation=Ql;var fs=class extends qn{constructor(t,e,n){super(t,e,n)}};fs.prototype.ValueTypeName="bool";fs.prototype.ValueBufferType=Array;fs.prototype.DefaultInterpolation=Fa;fs.prototype.InterpolantFactoryMethodLinear=void 0;fs.prototype.InterpolantFactoryMethodSmooth=void 0;var dc=class extends qn{constructor(t,e,n,s){super(t,e,n,s)}};dc.prototype.ValueTypeName="color";var pc=class extends qn{constructor(t,e,n,s){super(t,e,n,s)}};pc.prototype.ValueTypeName="number";var mc=class extends us{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,l=(n-e)/(s-e),c=t*o;for(let h=c+o;c!==h;c+=4)xn.slerpFlat(r,0,a,c-o,a,c,l);return r}},no=class extends qn{constructor(t,e,n,s){super(t,e,n,s)}InterpolantFactoryMethodLinear(t){return new mc(this.times,this.values,this.getValueSize(),t)}};no.prototype.ValueTypeName="quaternion";no.prototype.InterpolantFactoryMethodSmooth=void 0;var ds=class extends qn{constructor(t,e,n){super(t,e,n)}};ds.prototype.ValueTypeName="string";ds.prototype.ValueBufferType=Array;ds.prototype.DefaultInterpolation=Fa;ds.prototype.InterpolantFactoryMethodLinear=void 0;ds.prototype.InterpolantFactoryMethodSmooth=void 0;var gc=class extends qn{constructor(t,e,n,s){super(t,e,n,s)}};gc.prototype.ValueTypeName="vector";var _c=class{constructor(t,e,n){let s=this,r=!1,a=0,o=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this._abortController=null,this.itemStart=function(h){o++,r===!1&&s.onStart!==void 0&&s.onStart(h,a,o),r=!0},this.itemEnd=function(h){a++,s.onProgress!==void 0&&s.onProgress(h,a,o),a===o&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,f=c.length;u<f;u+=2){let d=c[u],m=c[u+1];if(d.global&&(d.lastIndex=0),d.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},X0=new _c,yc=class{constructor(t){this.manager=t!==void 0?t:X0,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let n=this;return new Promise(function(s,r){n.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};yc.DEFAULT_MATERIAL_NAME="__DEFAULT";var Wr=class extends un{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new Jt(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}},io=class extends Wr{constructor(t,e,n){super(t,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(un.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Jt(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}toJSON(t){let e=super.toJSON(t);return e.object.groundColor=this.groundColor.getHex(),e}},bf=new re,Jg=new B,Kg=new B,xc=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new zt(512,512),this.mapType=Un,this.map=null,this.mapPass=null,this.matrix=new re,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new hs,this._frameExtents=new zt(1,1),this._viewportCount=1,this._viewports=[new be(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;Jg.setFromMatrixPosition(t.matrixWorld),e.position.copy(Jg),Kg.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(Kg),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,n,s){bf.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),n.setFromProjectionMatrix(bf,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,a=s?s.z/r.x:1,o=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;t.coordinateSystem===Dr||t.reversedDepth?e.set(.5*a,0,0,.5*a+l,0,.5*o,0,.5*o+c,0,0,1,0,0,0,0,1):e.set(.5*a,0,0,.5*a+l,0,.5*o,0,.5*o+c,0,0,.5,.5,0,0,0,1),e.multiply(bf)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},zl=new B,Gl=new xn,Mi=new B,so=class extends un{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new re,this.projectionMatrix=new re,this.projectionMatrixInverse=new re,this.coordinateSystem=ii,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(zl,Gl,Mi),Mi.x===1&&Mi.y===1&&Mi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(zl,Gl,Mi.set(1,1,1)).invert()}updateWorldMatrix(t,e,n=!1){super.updateWorldMatrix(t,e,n),this.matrixWorld.decompose(zl,Gl,Mi),Mi.x===1&&Mi.y===1&&Mi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(zl,Gl,Mi.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ls=new B,jg=new zt,Qg=new zt,Rn=class extends so{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Ur*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(Oa*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Ur*2*Math.atan(Math.tan(Oa*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){ls.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(ls.x,ls.y).multiplyScalar(-t/ls.z),ls.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ls.x,ls.y).multiplyScalar(-t/ls.z)}getViewSize(t,e){return this.getViewBounds(t,jg,Qg),e.subVectors(Qg,jg)}setViewOffset(t,e,n,s,r,a){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(Oa*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s,a=this.view;if(this.view!==null&&this.view.enabled){let l=a.fullWidth,c=a.fullHeight;r+=a.offsetX*s/l,e-=a.offsetY*n/c,s*=a.width/l,n*=a.height/c}let o=this.filmOffset;o!==0&&(r+=t*o/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var ro=class extends so{constructor(t=-1,e=1,n=1,s=-1,r=.1,a=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=a,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,a){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-t,a=n+t,o=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,a=r+c*this.view.width,o-=h*this.view.offsetY,l=o-h*this.view.height}this.projectionMatrix.makeOrthographic(r,a,o,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},Rf=class extends xc{constructor(){super(new ro(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},ao=class extends Wr{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(un.DEFAULT_UP),this.updateMatrix(),this.target=new un,this.shadow=new Rf}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}},oo=class extends Wr{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}};var Pr=-90,Ir=1,Xr=class extends un{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Rn(Pr,Ir,t,e);s.layers=this.layers,this.add(s);let r=new Rn(Pr,Ir,t,e);r.layers=this.layers,this.add(r);let a=new Rn(Pr,Ir,t,e);a.layers=this.layers,this.add(a);let o=new Rn(Pr,Ir,t,e);o.layers=this.layers,this.add(o);let l=new Rn(Pr,Ir,t,e);l.layers=this.layers,this.add(l);let c=new Rn(Pr,Ir,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,s,r,a,o,l]=e;for(let c of e)this.remove(c);if(t===ii)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),a.up.set(0,0,1),a.lookAt(0,-1,0),o.up.set(0,1,0),o.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Dr)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),a.up.set(0,0,-1),a.lookAt(0,-1,0),o.up.set(0,-1,0),o.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,a,o,l,c,h]=this.children,u=t.getRenderTarget(),f=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),m=t.xr.enabled;t.xr.enabled=!1;let _=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(n,0,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(n,1,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(n,2,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(n,3,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(n,4,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),n.texture.mipmapsAutoUpdate=_,t.setRenderTarget(n,5,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,f,d),t.xr.enabled=m,n.texture.needsPMREMUpdate=!0}},vc=class extends Rn{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var cd="\\[\\]\\.:\\/",ub=new RegExp("["+cd+"]","g"),hd="[^"+cd+"]",fb="[^"+cd.replace("\\.","")+"]",db=/((?:WC+[\/:])*)/.source.replace("WC",hd),pb=/(WCOD+)?/.source.replace("WCOD",fb),mb=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",hd),gb=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",hd),_b=new RegExp("^"+db+pb+mb+gb+"$"),yb=["material","materials","bones","map"],Cf=class{constructor(t,e,n){let s=n||Oe.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},Oe=class i{constructor(t,e,n){this.path=e,this.parsedPath=n||i.parseTrackName(e),this.node=i.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new i.Composite(t,e,n):new i(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(ub,"")}static parseTrackName(t){let e=_b.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);yb.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let a=0;a<r.length;a++){let o=r[a];if(o.name===e||o.uuid===e)return o;let l=n(o.children);if(l)return l}return null},s=n(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)t[e++]=n[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=i.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Ut("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){Ht("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Ht("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Ht("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Ht("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Ht("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){Ht("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){Ht("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let a=t[s];if(a===void 0){let c=e.nodeName;Ht("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let o=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?o=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(o=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Ht("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Ht("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=a,this.propertyIndex=r}else a.fromArray!==void 0&&a.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=a):Array.isArray(a)?(l=this.BindingType.EntireArray,this.resolvedProperty=a):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][o]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Oe.Composite=Cf;Oe.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Oe.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Oe.prototype.GetterByBindingType=[Oe.prototype._getValue_direct,Oe.prototype._getValue_array,Oe.prototype._getValue_arrayElement,Oe.prototype._getValue_toArray];Oe.prototype.SetterByBindingTypeAndVersioning=[[Oe.prototype._setValue_direct,Oe.prototype._setValue_direct_setNeedsUpdate,Oe.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Oe.prototype._setValue_array,Oe.prototype._setValue_array_setNeedsUpdate,Oe.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Oe.prototype._setValue_arrayElement,Oe.prototype._setValue_arrayElement_setNeedsUpdate,Oe.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Oe.prototype._setValue_fromArray,Oe.prototype._setValue_fromArray_setNeedsUpdate,Oe.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var ER=new Float32Array(1);var t0=new re,lo=class{constructor(t,e,n=0,s=1/0){this.ray=new Xi(t,e),this.near=n,this.far=s,this.camera=null,this.layers=new Br,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Ht("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return t0.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(t0),this}intersectObject(t,e=!0,n=[]){return Pf(t,this,n,e),n.sort(e0),n}intersectObjects(t,e=!0,n=[]){for(let s=0,r=t.length;s<r;s++)Pf(t[s],this,n,e);return n.sort(e0),n}};function e0(i,t){return i.distance-t.distance}function Pf(i,t,e,n){let s=!0;if(i.layers.test(t.layers)&&i.raycast(t,e)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let a=0,o=r.length;a<o;a++)Pf(r[a],t,e,!0)}}var ps=class{constructor(t=1,e=0,n=0){this.radius=t,this.phi=e,this.theta=n}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=se(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(se(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var If=class{static{this.prototype.isMatrix2=!0}constructor(t,e,n,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let n=0;n<4;n++)this.elements[n]=t[n+e];return this}set(t,e,n,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=n,r[3]=s,this}};var co=class extends di{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function ud(i,t,e,n){let s=xb(n);switch(e){case Jf:return i*t;case jf:return i*t/s.components*s.byteLength;case Rc:return i*t/s.components*s.byteLength;case ys:return i*t*2/s.components*s.byteLength;case Cc:return i*t*2/s.components*s.byteLength;case Kf:return i*t*3/s.components*s.byteLength;case ri:return i*t*4/s.components*s.byteLength;case Pc:return i*t*4/s.components*s.byteLength;case uo:case fo:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case po:case mo:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Lc:case Dc:return Math.max(i,16)*Math.max(t,8)/4;case Ic:case Nc:return Math.max(i,8)*Math.max(t,8)/2;case Oc:case Uc:case Bc:case kc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Fc:case go:case zc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Gc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Vc:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case Hc:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case Wc:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case Xc:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case $c:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case qc:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case Yc:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case Zc:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case Jc:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case Kc:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case jc:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case Qc:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case th:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case eh:case nh:case ih:return Math.ceil(i/4)*Math.ceil(t/4)*16;case sh:case rh:return Math.ceil(i/4)*Math.ceil(t/4)*8;case _o:case ah:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function xb(i){switch(i){case Un:case $f:return{byteLength:1,components:1};case Zr:case qf:case mi:return{byteLength:2,components:1};case Ac:case Tc:return{byteLength:2,components:4};case pi:case Ec:case si:return{byteLength:4,components:1};case Yf:case Zf:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Ut("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function d_(){let i=null,t=!1,e=null,n=null;function s(r,a){n=i.requestAnimationFrame(s),e(r,a)}return{start:function(){t!==!0&&e!==null&&i!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function Mb(i){let t=new WeakMap;function e(o,l){let c=o.array,h=o.usage,u=c.byteLength,f=i.createBuffer();i.bindBuffer(l,f),i.bufferData(l,c,h),o.onUploadCallback();let d;if(c instanceof Float32Array)d=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)d=i.HALF_FLOAT;else if(c instanceof Uint16Array)o.isFloat16BufferAttribute?d=i.HALF_FLOAT:d=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)d=i.SHORT;else if(c instanceof Uint32Array)d=i.UNSIGNED_INT;else if(c instanceof Int32Array)d=i.INT;else if(c instanceof Int8Array)d=i.BYTE;else if(c instanceof Uint8Array)d=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)d=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:f,type:d,bytesPerElement:c.BYTES_PER_ELEMENT,version:o.version,size:u}}function n(o,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,o),u.length===0)i.bufferSubData(c,0,h);else{u.sort((d,m)=>d.start-m.start);let f=0;for(let d=1;d<u.length;d++){let m=u[f],_=u[d];_.start<=m.start+m.count+1?m.count=Math.max(m.count,_.start+_.count-m.start):(++f,u[f]=_)}u.length=f+1;for(let d=0,m=u.length;d<m;d++){let _=u[d];i.bufferSubData(c,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(o){return o.isInterleavedBufferAttribute&&(o=o.data),t.get(o)}function r(o){o.isInterleavedBufferAttribute&&(o=o.data);let l=t.get(o);l&&(i.deleteBuffer(l.buffer),t.delete(o))}function a(o,l){if(o.isInterleavedBufferAttribute&&(o=o.data),o.isGLBufferAttribute){let h=t.get(o);(!h||h.version<o.version)&&t.set(o,{buffer:o.buffer,type:o.type,bytesPerElement:o.elementSize,version:o.version});return}let c=t.get(o);if(c===void 0)t.set(o,e(o,l));else if(c.version<o.version){if(c.size!==o.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,o,l),c.version=o.version}}return{get:s,remove:r,update:a}}var bb=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,wb=`#ifdef USE_ALPHAHASH
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
#endif`,Sb=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Eb=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Ab=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Tb=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,Rb=`#ifdef USE_AOMAP
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
#endif`,Cb=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Pb=`#ifdef USE_BATCHING
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
#endif`,Ib=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Lb=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Nb=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,Db=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,Ob=`#ifdef USE_IRIDESCENCE
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
#endif`,Ub=`#ifdef USE_BUMPMAP
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
#endif`,Fb=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,Bb=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,kb=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,zb=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Gb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Vb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Hb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Wb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
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
#endif`,Xb=`#define PI 3.141592653589793
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
} // validated`,$b=`vec3 transformedNormal = objectNormal;
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
#endif`,qb=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Yb=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Zb=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Jb=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Kb="gl_FragColor = linearToOutputTexel( gl_FragColor );",jb=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Qb=`#ifdef USE_ENVMAP
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
#endif`,tw=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,ew=`#ifdef USE_ENVMAP
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
#endif`,nw=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,iw=`#ifdef USE_ENVMAP
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
#endif`,sw=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,rw=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,aw=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,ow=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,lw=`#ifdef USE_GRADIENTMAP
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
}`,cw=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,hw=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,uw=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,fw=`uniform bool receiveShadow;
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
#include <lightprobes_pars_fragment>`,dw=`#ifdef USE_ENVMAP
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
#endif`,pw=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,mw=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,gw=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,_w=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,yw=`PhysicalMaterial material;
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
#endif`,xw=`uniform sampler2D dfgLUT;
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
}`,vw=`
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
#endif`,Mw=`#if defined( RE_IndirectDiffuse )
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
#endif`,bw=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,ww=`#if NUM_LIGHT_PROBE_GRIDS > 0
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
#endif`,Sw=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,Ew=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Aw=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Tw=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,Rw=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,Cw=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,Pw=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,Iw=`#if defined( USE_POINTS_UV )
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
#endif`,Lw=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,Nw=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,Dw=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,Ow=`#if defined( USE_MORPHCOLORS )
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
#endif`,Uw=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Fw=`#ifdef USE_MORPHTARGETS
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
#endif`,Bw=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,kw=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
vec3 nonPerturbedNormal = normal;`,zw=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
#endif`,Gw=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Vw=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Hw=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,Ww=`#ifdef USE_NORMALMAP
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
#endif`,Xw=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,$w=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,qw=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Yw=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Zw=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Jw=`vec3 packNormalToRGB( const in vec3 normal ) {
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
}`,Kw=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,jw=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Qw=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,tS=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,eS=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,nS=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,iS=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,sS=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,rS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
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
#endif`,aS=`float getShadowMask() {
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
}`,oS=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,lS=`#ifdef USE_SKINNING
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
#endif`,cS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,hS=`#ifdef USE_SKINNING
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
#endif`,uS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,fS=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,dS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,pS=`#ifndef saturate
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,mS=`#ifdef USE_TRANSMISSION
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
#endif`,gS=`#ifdef USE_TRANSMISSION
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
#endif`,_S=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,yS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,xS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,vS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,MS=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,bS=`uniform sampler2D t2D;
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
}`,wS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,SS=`uniform float backgroundBlurriness;
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
}`,ES=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,AS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,TS=`#include <common>
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
}`,RS=`#if DEPTH_PACKING == 3200
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
}`,CS=`#define DISTANCE
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
}`,PS=`#define DISTANCE
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
}`,IS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,LS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,NS=`uniform float scale;
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
}`,DS=`uniform vec3 diffuse;
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
}`,OS=`#include <common>
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
}`,US=`uniform vec3 diffuse;
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
}`,FS=`#define LAMBERT
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
}`,BS=`#define LAMBERT
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
}`,kS=`#define MATCAP
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
}`,zS=`#define MATCAP
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
}`,GS=`#define NORMAL
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
}`,VS=`#define NORMAL
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
}`,HS=`#define PHONG
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
}`,WS=`#define PHONG
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
}`,XS=`#define STANDARD
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
}`,$S=`#define STANDARD
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
}`,qS=`#define TOON
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
}`,YS=`#define TOON
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
}`,ZS=`uniform float size;
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
}`,JS=`uniform vec3 diffuse;
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
}`,KS=`#include <common>
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
}`,jS=`uniform vec3 color;
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
}`,QS=`uniform float rotation;
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
}`,t1=`uniform vec3 diffuse;
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
}`,te={alphahash_fragment:bb,alphahash_pars_fragment:wb,alphamap_fragment:Sb,alphamap_pars_fragment:Eb,alphatest_fragment:Ab,alphatest_pars_fragment:Tb,aomap_fragment:Rb,aomap_pars_fragment:Cb,batching_pars_vertex:Pb,batching_vertex:Ib,begin_vertex:Lb,beginnormal_vertex:Nb,bsdfs:Db,iridescence_fragment:Ob,bumpmap_pars_fragment:Ub,clipping_planes_fragment:Fb,clipping_planes_pars_fragment:Bb,clipping_planes_pars_vertex:kb,clipping_planes_vertex:zb,color_fragment:Gb,color_pars_fragment:Vb,color_pars_vertex:Hb,color_vertex:Wb,common:Xb,defaultnormal_vertex:$b,displacementmap_pars_vertex:qb,displacementmap_vertex:Yb,emissivemap_fragment:Zb,emissivemap_pars_fragment:Jb,colorspace_fragment:Kb,colorspace_pars_fragment:jb,envmap_fragment:Qb,envmap_common_pars_fragment:tw,envmap_pars_fragment:ew,envmap_pars_vertex:nw,envmap_physical_pars_fragment:dw,envmap_vertex:iw,fog_vertex:sw,fog_pars_vertex:rw,fog_fragment:aw,fog_pars_fragment:ow,gradientmap_pars_fragment:lw,lightmap_pars_fragment:cw,lights_lambert_fragment:hw,lights_lambert_pars_fragment:uw,lights_pars_begin:fw,lights_toon_fragment:pw,lights_toon_pars_fragment:mw,lights_phong_fragment:gw,lights_phong_pars_fragment:_w,lights_physical_fragment:yw,lights_physical_pars_fragment:xw,lights_fragment_begin:vw,lights_fragment_maps:Mw,lights_fragment_end:bw,lightprobes_pars_fragment:ww,logdepthbuf_fragment:Sw,logdepthbuf_pars_fragment:Ew,logdepthbuf_pars_vertex:Aw,logdepthbuf_vertex:Tw,map_fragment:Rw,map_pars_fragment:Cw,map_particle_fragment:Pw,map_particle_pars_fragment:Iw,metalnessmap_fragment:Lw,metalnessmap_pars_fragment:Nw,morphinstance_vertex:Dw,morphcolor_vertex:Ow,morphnormal_vertex:Uw,morphtarget_pars_vertex:Fw,morphtarget_vertex:Bw,normal_fragment_begin:kw,normal_fragment_maps:zw,normal_pars_fragment:Gw,normal_pars_vertex:Vw,normal_vertex:Hw,normalmap_pars_fragment:Ww,clearcoat_normal_fragment_begin:Xw,clearcoat_normal_fragment_maps:$w,clearcoat_pars_fragment:qw,iridescence_pars_fragment:Yw,opaque_fragment:Zw,packing:Jw,premultiplied_alpha_fragment:Kw,project_vertex:jw,dithering_fragment:Qw,dithering_pars_fragment:tS,roughnessmap_fragment:eS,roughnessmap_pars_fragment:nS,shadowmap_pars_fragment:iS,shadowmap_pars_vertex:sS,shadowmap_vertex:rS,shadowmask_pars_fragment:aS,skinbase_vertex:oS,skinning_pars_vertex:lS,skinning_vertex:cS,skinnormal_vertex:hS,specularmap_fragment:uS,specularmap_pars_fragment:fS,tonemapping_fragment:dS,tonemapping_pars_fragment:pS,transmission_fragment:mS,transmission_pars_fragment:gS,uv_pars_fragment:_S,uv_pars_vertex:yS,uv_vertex:xS,worldpos_vertex:vS,background_vert:MS,background_frag:bS,backgroundCube_vert:wS,backgroundCube_frag:SS,cube_vert:ES,cube_frag:AS,depth_vert:TS,depth_frag:RS,distance_vert:CS,distance_frag:PS,equirect_vert:IS,equirect_frag:LS,linedashed_vert:NS,linedashed_frag:DS,meshbasic_vert:OS,meshbasic_frag:US,meshlambert_vert:FS,meshlambert_frag:BS,meshmatcap_vert:kS,meshmatcap_frag:zS,meshnormal_vert:GS,meshnormal_frag:VS,meshphong_vert:HS,meshphong_frag:WS,meshphysical_vert:XS,meshphysical_frag:$S,meshtoon_vert:qS,meshtoon_frag:YS,points_vert:ZS,points_frag:JS,shadow_vert:KS,shadow_frag:jS,sprite_vert:QS,sprite_frag:t1},St={common:{diffuse:{value:new Jt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new $t},alphaMap:{value:null},alphaMapTransform:{value:new $t},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new $t}},envmap:{envMap:{value:null},envMapRotation:{value:new $t},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new $t}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new $t}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new $t},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new $t},normalScale:{value:new zt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new $t},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new $t}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new $t}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new $t}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Jt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Jt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new $t},alphaTest:{value:0},uvTransform:{value:new $t}},sprite:{diffuse:{value:new Jt(16777215)},opacity:{value:1},center:{value:new zt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new $t},alphaMap:{value:null},alphaMapTransform:{value:new $t},alphaTest:{value:0}}},Ri={basic:{uniforms:vn([St.common,St.specularmap,St.envmap,St.aomap,St.lightmap,St.fog]),vertexShader:te.meshbasic_vert,fragmentShader:te.meshbasic_frag},lambert:{uniforms:vn([St.common,St.specularmap,St.envmap,St.aomap,St.lightmap,St.emissivemap,St.bumpmap,St.normalmap,St.displacementmap,St.fog,St.lights,{emissive:{value:new Jt(0)},envMapIntensity:{value:1}}]),vertexShader:te.meshlambert_vert,fragmentShader:te.meshlambert_frag},phong:{uniforms:vn([St.common,St.specularmap,St.envmap,St.aomap,St.lightmap,St.emissivemap,St.bumpmap,St.normalmap,St.displacementmap,St.fog,St.lights,{emissive:{value:new Jt(0)},specular:{value:new Jt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:te.meshphong_vert,fragmentShader:te.meshphong_frag},standard:{uniforms:vn([St.common,St.envmap,St.aomap,St.lightmap,St.emissivemap,St.bumpmap,St.normalmap,St.displacementmap,St.roughnessmap,St.metalnessmap,St.fog,St.lights,{emissive:{value:new Jt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:te.meshphysical_vert,fragmentShader:te.meshphysical_frag},toon:{uniforms:vn([St.common,St.aomap,St.lightmap,St.emissivemap,St.bumpmap,St.normalmap,St.displacementmap,St.gradientmap,St.fog,St.lights,{emissive:{value:new Jt(0)}}]),vertexShader:te.meshtoon_vert,fragmentShader:te.meshtoon_frag},matcap:{uniforms:vn([St.common,St.bumpmap,St.normalmap,St.displacementmap,St.fog,{matcap:{value:null}}]),vertexShader:te.meshmatcap_vert,fragmentShader:te.meshmatcap_frag},points:{uniforms:vn([St.points,St.fog]),vertexShader:te.points_vert,fragmentShader:te.points_frag},dashed:{uniforms:vn([St.common,St.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:te.linedashed_vert,fragmentShader:te.linedashed_frag},depth:{uniforms:vn([St.common,St.displacementmap]),vertexShader:te.depth_vert,fragmentShader:te.depth_frag},normal:{uniforms:vn([St.common,St.bumpmap,St.normalmap,St.displacementmap,{opacity:{value:1}}]),vertexShader:te.meshnormal_vert,fragmentShader:te.meshnormal_frag},sprite:{uniforms:vn([St.sprite,St.fog]),vertexShader:te.sprite_vert,fragmentShader:te.sprite_frag},background:{uniforms:{uvTransform:{value:new $t},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:te.background_vert,fragmentShader:te.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new $t}},vertexShader:te.backgroundCube_vert,fragmentShader:te.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:te.cube_vert,fragmentShader:te.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:te.equirect_vert,fragmentShader:te.equirect_frag},distance:{uniforms:vn([St.common,St.displacementmap,{referencePosition:{value:new B},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:te.distance_vert,fragmentShader:te.distance_frag},shadow:{uniforms:vn([St.lights,St.fog,{color:{value:new Jt(0)},opacity:{value:1}}]),vertexShader:te.shadow_vert,fragmentShader:te.shadow_frag}};Ri.physical={uniforms:vn([Ri.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new $t},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new $t},clearcoatNormalScale:{value:new zt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new $t},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new $t},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new $t},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new $t},sheen:{value:0},sheenColor:{value:new Jt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new $t},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new $t},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new $t},transmissionSamplerSize:{value:new zt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new $t},attenuationDistance:{value:0},attenuationColor:{value:new Jt(0)},specularColor:{value:new Jt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new $t},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new $t},anisotropyVector:{value:new zt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new $t}}]),vertexShader:te.meshphysical_vert,fragmentShader:te.meshphysical_frag};var lh={r:0,b:0,g:0},e1=new re,p_=new $t;p_.set(-1,0,0,0,1,0,0,0,1);function n1(i,t,e,n,s,r){let a=new Jt(0),o=s===!0?0:1,l,c,h=null,u=0,f=null;function d(y){let w=y.isScene===!0?y.background:null;if(w&&w.isTexture){let b=y.backgroundBlurriness>0;w=t.get(w,b)}return w}function m(y){let w=!1,b=d(y);b===null?p(a,o):b&&b.isColor&&(p(b,1),w=!0);let E=i.xr.getEnvironmentBlendMode();E==="additive"?e.buffers.color.setClear(0,0,0,1,r):E==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(i.autoClear||w)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function _(y,w){let b=d(w);b&&b.isCubeTexture?(c===void 0&&(c=new On(new Hr(1,1,1),new Si({name:"BackgroundCubeMaterial",uniforms:Ys(Ri.backgroundCube.uniforms),vertexShader:Ri.backgroundCube.vertexShader,fragmentShader:Ri.backgroundCube.fragmentShader,side:In,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(E,T,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=b,c.material.uniforms.backgroundBlurriness.value=w.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(e1.makeRotationFromEuler(w.backgroundRotation)).transpose(),b.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(p_),c.material.toneMapped=ce.getTransfer(b.colorSpace)!==ve,(h!==b||u!==b.version||f!==i.toneMapping)&&(c.material.needsUpdate=!0,h=b,u=b.version,f=i.toneMapping),c.layers.enableAll(),y.unshift(c,c.geometry,c.material,0,0,null)):b&&b.isTexture&&(l===void 0&&(l=new On(new Gs(2,2),new Si({name:"BackgroundMaterial",uniforms:Ys(Ri.background.uniforms),vertexShader:Ri.background.vertexShader,fragmentShader:Ri.background.fragmentShader,side:_s,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=b,l.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,l.material.toneMapped=ce.getTransfer(b.colorSpace)!==ve,b.matrixAutoUpdate===!0&&b.updateMatrix(),l.material.uniforms.uvTransform.value.copy(b.matrix),(h!==b||u!==b.version||f!==i.toneMapping)&&(l.material.needsUpdate=!0,h=b,u=b.version,f=i.toneMapping),l.layers.enableAll(),y.unshift(l,l.geometry,l.material,0,0,null))}function p(y,w){y.getRGB(lh,ld(i)),e.buffers.color.setClear(lh.r,lh.g,lh.b,w,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return a},setClearColor:function(y,w=1){a.set(y),o=w,p(a,o)},getClearAlpha:function(){return o},setClearAlpha:function(y){o=y,p(a,o)},render:m,addToRenderList:_,dispose:g}}function i1(i,t){let e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=f(null),r=s,a=!1;function o(O,H,Z,P,W){let tt=!1,$=u(O,P,Z,H);r!==$&&(r=$,c(r.object)),tt=d(O,P,Z,W),tt&&m(O,P,Z,W),W!==null&&t.update(W,i.ELEMENT_ARRAY_BUFFER),(tt||a)&&(a=!1,b(O,H,Z,P),W!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(W).buffer))}function l(){return i.createVertexArray()}function c(O){return i.bindVertexArray(O)}function h(O){return i.deleteVertexArray(O)}function u(O,H,Z,P){let W=P.wireframe===!0,tt=n[H.id];tt===void 0&&(tt={},n[H.id]=tt);let $=O.isInstancedMesh===!0?O.id:0,at=tt[$];at===void 0&&(at={},tt[$]=at);let X=at[Z.id];X===void 0&&(X={},at[Z.id]=X);let k=X[W];return k===void 0&&(k=f(l()),X[W]=k),k}function f(O){let H=[],Z=[],P=[];for(let W=0;W<e;W++)H[W]=0,Z[W]=0,P[W]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:H,enabledAttributes:Z,attributeDivisors:P,object:O,attributes:{},index:null}}function d(O,H,Z,P){let W=r.attributes,tt=H.attributes,$=0,at=Z.getAttributes();for(let X in at)if(at[X].location>=0){let it=W[X],Tt=tt[X];if(Tt===void 0&&(X==="instanceMatrix"&&O.instanceMatrix&&(Tt=O.instanceMatrix),X==="instanceColor"&&O.instanceColor&&(Tt=O.instanceColor)),it===void 0||it.attribute!==Tt||Tt&&it.data!==Tt.data)return!0;$++}return r.attributesNum!==$||r.index!==P}function m(O,H,Z,P){let W={},tt=H.attributes,$=0,at=Z.getAttributes();for(let X in at)if(at[X].location>=0){let it=tt[X];it===void 0&&(X==="instanceMatrix"&&O.instanceMatrix&&(it=O.instanceMatrix),X==="instanceColor"&&O.instanceColor&&(it=O.instanceColor));let Tt={};Tt.attribute=it,it&&it.data&&(Tt.data=it.data),W[X]=Tt,$++}r.attributes=W,r.attributesNum=$,r.index=P}function _(){let O=r.newAttributes;for(let H=0,Z=O.length;H<Z;H++)O[H]=0}function p(O){g(O,0)}function g(O,H){let Z=r.newAttributes,P=r.enabledAttributes,W=r.attributeDivisors;Z[O]=1,P[O]===0&&(i.enableVertexAttribArray(O),P[O]=1),W[O]!==H&&(i.vertexAttribDivisor(O,H),W[O]=H)}function y(){let O=r.newAttributes,H=r.enabledAttributes;for(let Z=0,P=H.length;Z<P;Z++)H[Z]!==O[Z]&&(i.disableVertexAttribArray(Z),H[Z]=0)}function w(O,H,Z,P,W,tt,$){$===!0?i.vertexAttribIPointer(O,H,Z,W,tt):i.vertexAttribPointer(O,H,Z,P,W,tt)}function b(O,H,Z,P){_();let W=P.attributes,tt=Z.getAttributes(),$=H.defaultAttributeValues;for(let at in tt){let X=tt[at];if(X.location>=0){let k=W[at];if(k===void 0&&(at==="instanceMatrix"&&O.instanceMatrix&&(k=O.instanceMatrix),at==="instanceColor"&&O.instanceColor&&(k=O.instanceColor)),k!==void 0){let it=k.normalized,Tt=k.itemSize,kt=t.get(k);if(kt===void 0)continue;let et=kt.buffer,pt=kt.type,_t=kt.bytesPerElement,Nt=pt===i.INT||pt===i.UNSIGNED_INT||k.gpuType===Ec;if(k.isInterleavedBufferAttribute){let lt=k.data,At=lt.isInterleavedBuffer===!0?lt.stride:lt.itemSize,ae=k.offset;if(lt.isInstancedInterleavedBuffer||lt.isInstancedBufferAttribute){for(let Ft=0;Ft<X.locationSize;Ft++)g(X.location+Ft,lt.meshPerAttribute);O.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=lt.meshPerAttribute*lt.count)}else for(let Ft=0;Ft<X.locationSize;Ft++)p(X.location+Ft);i.bindBuffer(i.ARRAY_BUFFER,et);for(let Ft=0;Ft<X.locationSize;Ft++)w(X.location+Ft,Tt/X.locationSize,pt,it,At*_t,(ae+Tt/X.locationSize*Ft)*_t,Nt)}else{if(k.isInstancedBufferAttribute){for(let lt=0;lt<X.locationSize;lt++)g(X.location+lt,k.meshPerAttribute);O.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=k.meshPerAttribute*k.count)}else for(let lt=0;lt<X.locationSize;lt++)p(X.location+lt);i.bindBuffer(i.ARRAY_BUFFER,et);for(let lt=0;lt<X.locationSize;lt++)w(X.location+lt,Tt/X.locationSize,pt,it,Tt*_t,Tt/X.locationSize*lt*_t,Nt)}}else if($!==void 0){let it=$[at];if(it!==void 0)switch(it.length){case 2:i.vertexAttrib2fv(X.location,it);break;case 3:i.vertexAttrib3fv(X.location,it);break;case 4:i.vertexAttrib4fv(X.location,it);break;default:i.vertexAttrib1fv(X.location,it)}}}}y()}function E(){F();for(let O in n){let H=n[O];for(let Z in H){let P=H[Z];for(let W in P){let tt=P[W];for(let $ in tt)h(tt[$].object),delete tt[$];delete P[W]}}delete n[O]}}function T(O){if(n[O.id]===void 0)return;let H=n[O.id];for(let Z in H){let P=H[Z];for(let W in P){let tt=P[W];for(let $ in tt)h(tt[$].object),delete tt[$];delete P[W]}}delete n[O.id]}function x(O){for(let H in n){let Z=n[H];for(let P in Z){let W=Z[P];if(W[O.id]===void 0)continue;let tt=W[O.id];for(let $ in tt)h(tt[$].object),delete tt[$];delete W[O.id]}}}function A(O){for(let H in n){let Z=n[H],P=O.isInstancedMesh===!0?O.id:0,W=Z[P];if(W!==void 0){for(let tt in W){let $=W[tt];for(let at in $)h($[at].object),delete $[at];delete W[tt]}delete Z[P],Object.keys(Z).length===0&&delete n[H]}}}function F(){L(),a=!0,r!==s&&(r=s,c(r.object))}function L(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:o,reset:F,resetDefaultState:L,dispose:E,releaseStatesOfGeometry:T,releaseStatesOfObject:A,releaseStatesOfProgram:x,initAttributes:_,enableAttribute:p,disableUnusedAttributes:y}}function s1(i,t,e){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),e.update(c,n,1)}function a(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),e.update(c,n,h))}function o(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let f=0;for(let d=0;d<h;d++)f+=c[d];e.update(f,n,1)}this.setMode=s,this.render=r,this.renderInstances=a,this.renderMultiDraw=o}function r1(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function a(x){return!(x!==ri&&n.convert(x)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function o(x){let A=x===mi&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==Un&&x!==si&&!A&&n.convert(x)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(Ut("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),f=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Ut("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Ut("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),m=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=i.getParameter(i.MAX_TEXTURE_SIZE),p=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),y=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),w=i.getParameter(i.MAX_VARYING_VECTORS),b=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),E=i.getParameter(i.MAX_SAMPLES),T=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:a,textureTypeReadable:o,precision:c,logarithmicDepthBuffer:f,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:m,maxTextureSize:_,maxCubemapSize:p,maxAttributes:g,maxVertexUniforms:y,maxVaryings:w,maxFragmentUniforms:b,maxSamples:E,samples:T}}function a1(i){let t=this,e=null,n=0,s=!1,r=!1,a=new Tn,o=new $t,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){let d=u.length!==0||f||n!==0||s;return s=f,n=u.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){e=h(u,f,0)},this.setState=function(u,f,d){let m=u.clippingPlanes,_=u.clipIntersection,p=u.clipShadows,g=i.get(u);if(!s||m===null||m.length===0||r&&!p)r?h(null):c();else{let y=r?0:n,w=y*4,b=g.clippingState||null;l.value=b,b=h(m,f,w,d);for(let E=0;E!==w;++E)b[E]=e[E];g.clippingState=b,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=y}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(u,f,d,m){let _=u!==null?u.length:0,p=null;if(_!==0){if(p=l.value,m!==!0||p===null){let g=d+_*4,y=f.matrixWorldInverse;o.getNormalMatrix(y),(p===null||p.length<g)&&(p=new Float32Array(g));for(let w=0,b=d;w!==_;++w,b+=4)a.copy(u[w]).applyMatrix4(y,o),a.normal.toArray(p,b),p[b+3]=a.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,p}}var vo=class extends $n{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new Ja(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},s=new Hr(5,5,5),r=new Si({name:"CubemapFromEquirect",uniforms:Ys(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:In,blending:Hs});r.uniforms.tEquirect.value=e;let a=new On(s,r),o=e.minFilter;return e.minFilter===qi&&(e.minFilter=Cn),new Xr(1,10,this).update(t,a),e.minFilter=o,a.geometry.dispose(),a.material.dispose(),this}clear(t,e=!0,n=!0,s=!0){let r=t.getRenderTarget();for(let a=0;a<6;a++)t.setRenderTarget(this,a),t.clear(e,n,s);t.setRenderTarget(r)}},$0=256,o1=3,l1=20,m_=256,g_=16,c1=3,h1=new B,u1=new Jt,hh=class i{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Xr(1,10,null),this._boxMesh=new On(new Hr(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,n=.1,s=100,r={}){let{size:a=256,position:o=h1}=r,l=this._renderer;this._setSize(a);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,f=l.autoClearColor,d=l.autoClearDepth,m=l.autoClearStencil,_=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,_===null&&(t.background=l.getClearColor(u1));let p=new Xr(n,s,h);return p.position.copy(o),p.update(l,t),l.autoClear=u,l.autoClearColor=f,l.autoClearDepth=d,l.autoClearStencil=m,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Z0(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Y0(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max($0,rd(t))}_fromTexture(t,e){t.mapping===Xs||t.mapping===Yr?this._setSize(t.image.length===0?$0:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let n=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(n),n}_allocateTarget(){let t=this._cubeSize,e=q0(t,!1,!1),n=Math.log2(t)-o1;for(let s=0;s<=n;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==e||t&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=q0(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=t,r.activeMipmapLevel=e;let a=t.width>>e;t.viewport.set(0,0,a,a),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Xs||t.mapping===Yr?(this._cubemapMaterial===null&&(this._cubemapMaterial=Z0()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Y0()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=f1(),this._integrationMaterial=d1());let e=this._cubeSize,n=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/g_);for(let a=0;a<=n;a++){let o=i.lodToRoughness(a,n);if(a>n-c1)r.roughness.value=o,this._renderCube(t,a,this._integrationMaterial);else{let l=o>0?Math.log2(e)+.5*Math.log2(6/(m_*Math.pow(o,4)))+.5:0;s.roughness.value=o,s.lodBias.value=l,this._renderCube(t,a,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=p1());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,n),s.envMap.value=t.texture,this._renderCube(r,0,n)}};function q0(i,t,e){return new vo(i,{minFilter:qi,generateMipmaps:t,type:mi,colorSpace:Ba,depthBuffer:e})}function Mo(i,t,e){return new Si({name:i,uniforms:t,vertexShader:te.cube_vert,fragmentShader:e,side:In,blending:Hs,depthTest:!1,depthWrite:!1})}function f1(){return Mo("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${m_}u

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
	`)}function d1(){return Mo("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:g_}},`

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
	`)}function p1(){return Mo("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${l1}
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
	`)}function Y0(){return Mo("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

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
	`)}function Z0(){return Mo("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function m1(i){let t=new WeakMap,e=new WeakMap,n=null;function s(f,d=!1){return f==null?null:d?a(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===bc||d===wc)if(t.has(f)){let m=t.get(f).texture;return o(m,f.mapping)}else{let m=f.image;if(m&&m.height>0){let _=new vo(m.height);return _.fromEquirectangularTexture(i,f),t.set(f,_),f.addEventListener("dispose",c),o(_.texture,f.mapping)}else return null}}return f}function a(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,m=d===bc||d===wc,_=d===Xs||d===Yr;if(m||_){let p=e.get(f),g=p!==void 0?p.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==g)return n===null&&(n=new hh(i)),p=m?n.fromEquirectangular(f,p):n.fromCubemap(f,p),p.texture.pmremVersion=f.pmremVersion,e.set(f,p),p.texture;if(p!==void 0)return p.texture;{let y=f.image;return m&&y&&y.height>0||_&&y&&l(y)?(n===null&&(n=new hh(i)),p=m?n.fromEquirectangular(f):n.fromCubemap(f),p.texture.pmremVersion=f.pmremVersion,e.set(f,p),f.addEventListener("dispose",h),p.texture):null}}}return f}function o(f,d){return d===bc?f.mapping=Xs:d===wc&&(f.mapping=Yr),f}function l(f){let d=0,m=6;for(let _=0;_<m;_++)f[_]!==void 0&&d++;return d===m}function c(f){let d=f.target;d.removeEventListener("dispose",c);let m=t.get(d);m!==void 0&&(t.delete(d),m.dispose())}function h(f){let d=f.target;d.removeEventListener("dispose",h);let m=e.get(d);m!==void 0&&(e.delete(d),m.dispose())}function u(){t=new WeakMap,e=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function g1(i){let t={};function e(n){if(t[n]!==void 0)return t[n];let s=i.getExtension(n);return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let s=e(n);return s===null&&Da("WebGLRenderer: "+n+" extension not supported."),s}}}function _1(i,t,e,n){let s={},r=new WeakMap,a=new FinalizationRegistry(m=>delete s[m]);function o(m){l(m.target)}function l(m){m.index!==null&&t.remove(m.index);for(let p in m.attributes)t.remove(m.attributes[p]);m.removeEventListener("dispose",o),delete s[m.id],a.unregister(m);let _=r.get(m);_&&(t.remove(_),r.delete(m)),n.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,e.memory.geometries--}function c(m,_){return s[_.id]!==void 0||(_.addEventListener("dispose",o),s[_.id]=new WeakRef(_),a.register(_,_.id,_),e.memory.geometries++),_}function h(m){let _=m.attributes;for(let p in _)t.update(_[p],i.ARRAY_BUFFER)}function u(m){let _=m.index,p=m.attributes.position,g=0;if(p===void 0)return;let y=_!==null?_.array.length:p.array.length/3-1,w=p.count>=65535?Xa:Wa,b=new w(Math.ceil(y/3)*6,1),E=b.array;if(_!==null){let x=_.array;g=_.version;for(let A=0,F=0;A<y;A+=3){let L=x[A+0],O=x[A+1],H=x[A+2];E[F++]=L,E[F++]=O,E[F++]=O,E[F++]=H,E[F++]=H,E[F++]=L}}else{g=p.version;for(let x=0,A=0;x<y;x+=3){let F=x+0,L=x+1,O=x+2;E[A++]=F,E[A++]=L,E[A++]=L,E[A++]=O,E[A++]=O,E[A++]=F}}b.version=g;let T=r.get(m);T&&t.remove(T),r.set(m,b)}function f(m){let _=r.get(m);if(_){let p=m.index;p!==null&&_.version<p.version&&u(m)}else u(m);return r.get(m)}function d(){for(let m in s){let _=s[m].deref();_!==void 0&&l(_)}}return{get:c,update:h,getWireframeAttribute:f,dispose:d}}function y1(i,t,e){let n;function s(u){n=u}let r,a;function o(u){r=u.type,a=u.bytesPerElement}function l(u,f){i.drawElements(n,f,r,u*a),e.update(f,n,1)}function c(u,f,d){d!==0&&(i.drawElementsInstanced(n,f,r,u*a,d),e.update(f,n,d))}function h(u,f,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,f,0,r,u,0,d);let _=0;for(let p=0;p<d;p++)_+=f[p];e.update(_,n,1)}this.setMode=s,this.setIndex=o,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function x1(i){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,a,o){switch(e.calls++,a){case i.TRIANGLES:e.triangles+=o*(r/3);break;case i.LINES:e.lines+=o*(r/2);break;case i.LINE_STRIP:e.lines+=o*(r-1);break;case i.LINE_LOOP:e.lines+=o*r;break;case i.POINTS:e.points+=o*r;break;default:Ht("WebGLInfo: Unknown draw mode:",a);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function v1(i,t,e){let n=new WeakMap,s=new be;function r(a,o,l){let c=a.morphTargetInfluences,h=o.morphAttributes.position||o.morphAttributes.normal||o.morphAttributes.color,u=h!==void 0?h.length:0,f=n.get(o);if(f===void 0||f.count!==u){let F=function(){x.dispose(),n.delete(o),o.removeEventListener("dispose",F)};f!==void 0&&f.texture.dispose();let d=o.morphAttributes.position!==void 0,m=o.morphAttributes.normal!==void 0,_=o.morphAttributes.color!==void 0,p=o.morphAttributes.position||[],g=o.morphAttributes.normal||[],y=o.morphAttributes.color||[],w=0;d===!0&&(w=1),m===!0&&(w=2),_===!0&&(w=3);let b=o.attributes.position.count*w,E=1;b>t.maxTextureSize&&(E=Math.ceil(b/t.maxTextureSize),b=t.maxTextureSize);let T=new Float32Array(b*E*4*u),x=new Ga(T,b,E,u);x.type=si,x.needsUpdate=!0;let A=w*4;for(let L=0;L<u;L++){let O=p[L],H=g[L],Z=y[L],P=b*E*4*L;for(let W=0;W<O.count;W++){let tt=W*A;d===!0&&(s.fromBufferAttribute(O,W),T[P+tt+0]=s.x,T[P+tt+1]=s.y,T[P+tt+2]=s.z,T[P+tt+3]=0),m===!0&&(s.fromBufferAttribute(H,W),T[P+tt+4]=s.x,T[P+tt+5]=s.y,T[P+tt+6]=s.z,T[P+tt+7]=0),_===!0&&(s.fromBufferAttribute(Z,W),T[P+tt+8]=s.x,T[P+tt+9]=s.y,T[P+tt+10]=s.z,T[P+tt+11]=Z.itemSize===4?s.w:1)}}f={count:u,texture:x,size:new zt(b,E)},n.set(o,f),o.addEventListener("dispose",F)}if(a.isInstancedMesh===!0&&a.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",a.morphTexture,e);else{let d=0;for(let _=0;_<c.length;_++)d+=c[_];let m=o.morphTargetsRelative?1:1-d;l.getUniforms().setValue(i,"morphTargetBaseInfluence",m),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",f.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",f.size)}return{update:r}}function M1(i,t,e,n,s){let r=new WeakMap;function a(c){let h=s.render.frame,u=c.geometry,f=t.get(c,u);if(r.get(f)!==h&&(t.update(f),r.set(f,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let d=c.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return f}function o(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:a,dispose:o}}var b1={[Bf]:"LINEAR_TONE_MAPPING",[kf]:"REINHARD_TONE_MAPPING",[zf]:"CINEON_TONE_MAPPING",[Gf]:"ACES_FILMIC_TONE_MAPPING",[Hf]:"AGX_TONE_MAPPING",[Wf]:"NEUTRAL_TONE_MAPPING",[Vf]:"CUSTOM_TONE_MAPPING"};function w1(i,t,e,n,s,r){let a=new $n(t,e,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),o=null,l=null,c=null,h=new Pn;h.setAttribute("position",new dn([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new dn([0,2,0,0,2,0],2));let u=new ac({uniforms:{tDiffuse:{value:null}},vertexShader:`
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
			}`,depthTest:!1,depthWrite:!1}),f=new On(h,u),d=new ro(-1,1,1,-1,0,1),m=null,_=null,p=!1,g,y=null,w=[],b=!1;this.setSize=function(E,T){a.setSize(E,T),o!==null&&o.setSize(E,T),l!==null&&l.setSize(E,T);for(let x=0;x<w.length;x++){let A=w[x];A.setSize&&A.setSize(E,T)}},this.setEffects=function(E){w=E,b=w.length>0&&w[0].isRenderPass===!0;let T=a.width,x=a.height;w.length>0&&o===null&&(o=new $n(T,x,{type:mi,depthBuffer:!1,stencilBuffer:!1}),l=new $n(T,x,{type:mi,depthBuffer:!1,stencilBuffer:!1}));let A=s===!0&&w.some(F=>F.needsDepthTexture===!0);A!==(a.depthTexture!==null)&&(A===!0&&c===null&&(c=new $i(T,x),r===!0&&(c.format=Yi,c.type=$s)),a.dispose(),a.depthTexture=A?c:null,a.resolveDepthBuffer=A,a.storeMultisampledDepthBuffer=A);for(let F=0;F<w.length;F++){let L=w[F];L.setSize&&L.setSize(T,x),A&&L.needsDepthTexture===!0&&L.setDepthTexture&&L.setDepthTexture(c)}},this.begin=function(E,T){if(p||E.toneMapping===Ai&&w.length===0)return!1;if(y=T,T!==null){let x=T.width,A=T.height;(a.width!==x||a.height!==A)&&this.setSize(x,A)}return b===!1&&E.setRenderTarget(a),g=E.toneMapping,E.toneMapping=Ai,!0},this.hasRenderPass=function(){return b},this.end=function(E,T){E.toneMapping=g,p=!0;let x=a,A=o;for(let F=0;F<w.length;F++){let L=w[F];L.enabled!==!1&&(L.render(E,A,x,T),L.needsSwap!==!1&&(x=A,A=A===o?l:o))}if(m!==E.outputColorSpace||_!==E.toneMapping){m=E.outputColorSpace,_=E.toneMapping,u.defines={},ce.getTransfer(m)===ve&&(u.defines.SRGB_TRANSFER="");let F=b1[_];F&&(u.defines[F]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,E.setRenderTarget(y),E.render(f,d),y=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){a.dispose(),o!==null&&o.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var __=new Dn,y_=new $i(1,1),x_=new Ka(1),v_=new Ga,M_=new nc,b_=new Ja,J0=[],K0=[],j0=new Float32Array(16),Q0=new Float32Array(9),t_=new Float32Array(4);function Kr(i,t,e){let n=i[0];if(n<=0||n>0)return i;let s=t*e,r=J0[s];if(r===void 0&&(r=new Float32Array(s),J0[s]=r),t!==0){n.toArray(r,0);for(let a=1,o=0;a!==t;++a)o+=e,i[a].toArray(r,o)}return r}function tn(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function en(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function fh(i,t){let e=K0[t];e===void 0&&(e=new Int32Array(t),K0[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function S1(i,t){let e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function E1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(tn(e,t))return;i.uniform2fv(this.addr,t),en(e,t)}}function A1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(tn(e,t))return;i.uniform3fv(this.addr,t),en(e,t)}}function T1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(tn(e,t))return;i.uniform4fv(this.addr,t),en(e,t)}}function R1(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(tn(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),en(e,t)}else{if(tn(e,n))return;t_.set(n),i.uniformMatrix2fv(this.addr,!1,t_),en(e,n)}}function C1(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(tn(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),en(e,t)}else{if(tn(e,n))return;Q0.set(n),i.uniformMatrix3fv(this.addr,!1,Q0),en(e,n)}}function P1(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(tn(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),en(e,t)}else{if(tn(e,n))return;j0.set(n),i.uniformMatrix4fv(this.addr,!1,j0),en(e,n)}}function I1(i,t){let e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function L1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(tn(e,t))return;i.uniform2iv(this.addr,t),en(e,t)}}function N1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(tn(e,t))return;i.uniform3iv(this.addr,t),en(e,t)}}function D1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(tn(e,t))return;i.uniform4iv(this.addr,t),en(e,t)}}function O1(i,t){let e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function U1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(tn(e,t))return;i.uniform2uiv(this.addr,t),en(e,t)}}function F1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(tn(e,t))return;i.uniform3uiv(this.addr,t),en(e,t)}}function B1(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(tn(e,t))return;i.uniform4uiv(this.addr,t),en(e,t)}}function dh(i){return i.version===0&&(i.compareFunction=ed,i.needsUpdate=!0),i}function k1(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=dh(y_):r=__,e.setTexture2D(t||r,s)}function z1(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||M_,s)}function G1(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=dh(x_):r=b_,e.setTextureCube(t||r,s)}function V1(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||v_,s)}function H1(i){switch(i){case 5126:return S1;case 35664:return E1;case 35665:return A1;case 35666:return T1;case 35674:return R1;case 35675:return C1;case 35676:return P1;case 5124:case 35670:return I1;case 35667:case 35671:return L1;case 35668:case 35672:return N1;case 35669:case 35673:return D1;case 5125:return O1;case 36294:return U1;case 36295:return F1;case 36296:return B1;case 35678:case 36198:case 36298:case 36306:case 35682:return k1;case 35679:case 36299:case 36307:return z1;case 35680:case 36300:case 36308:case 36293:return G1;case 36289:case 36303:case 36311:case 36292:return V1}}function W1(i,t){i.uniform1fv(this.addr,t)}function X1(i,t){let e=Kr(t,this.size,2);i.uniform2fv(this.addr,e)}function $1(i,t){let e=Kr(t,this.size,3);i.uniform3fv(this.addr,e)}function q1(i,t){let e=Kr(t,this.size,4);i.uniform4fv(this.addr,e)}function Y1(i,t){let e=Kr(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function Z1(i,t){let e=Kr(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function J1(i,t){let e=Kr(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function K1(i,t){i.uniform1iv(this.addr,t)}function j1(i,t){i.uniform2iv(this.addr,t)}function Q1(i,t){i.uniform3iv(this.addr,t)}function tE(i,t){i.uniform4iv(this.addr,t)}function eE(i,t){i.uniform1uiv(this.addr,t)}function nE(i,t){i.uniform2uiv(this.addr,t)}function iE(i,t){i.uniform3uiv(this.addr,t)}function sE(i,t){i.uniform4uiv(this.addr,t)}function rE(i,t,e){let n=this.cache,s=t.length,r=fh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));let a;this.type===i.SAMPLER_2D_SHADOW?a=dh(y_):a=__;for(let o=0;o!==s;++o)e.setTexture2D(t[o]||a,r[o])}function aE(i,t,e){let n=this.cache,s=t.length,r=fh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));for(let a=0;a!==s;++a)e.setTexture3D(t[a]||M_,r[a])}function oE(i,t,e){let n=this.cache,s=t.length,r=fh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));let a;this.type===i.SAMPLER_CUBE_SHADOW?a=dh(x_):a=b_;for(let o=0;o!==s;++o)e.setTextureCube(t[o]||a,r[o])}function lE(i,t,e){let n=this.cache,s=t.length,r=fh(e,s);tn(n,r)||(i.uniform1iv(this.addr,r),en(n,r));for(let a=0;a!==s;++a)e.setTexture2DArray(t[a]||v_,r[a])}function cE(i){switch(i){case 5126:return W1;case 35664:return X1;case 35665:return $1;case 35666:return q1;case 35674:return Y1;case 35675:return Z1;case 35676:return J1;case 5124:case 35670:return K1;case 35667:case 35671:return j1;case 35668:case 35672:return Q1;case 35669:case 35673:return tE;case 5125:return eE;case 36294:return nE;case 36295:return iE;case 36296:return sE;case 35678:case 36198:case 36298:case 36306:case 35682:return rE;case 35679:case 36299:case 36307:return aE;case 35680:case 36300:case 36308:case 36293:return oE;case 36289:case 36303:case 36311:case 36292:return lE}}var pd=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=H1(e.type)}},md=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=cE(e.type)}},gd=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let s=this.seq;for(let r=0,a=s.length;r!==a;++r){let o=s[r];o.setValue(t,e[o.id],n)}}},fd=/(\w+)(\])?(\[|\.)?/g;function e_(i,t){i.seq.push(t),i.map[t.id]=t}function hE(i,t,e){let n=i.name,s=n.length;for(fd.lastIndex=0;;){let r=fd.exec(n),a=fd.lastIndex,o=r[1],l=r[2]==="]",c=r[3];if(l&&(o=o|0),c===void 0||c==="["&&a+2===s){e_(e,c===void 0?new pd(o,i,t):new md(o,i,t));break}else{let u=e.map[o];u===void 0&&(u=new gd(o),e_(e,u)),e=u}}}var Jr=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let a=0;a<n;++a){let o=t.getActiveUniform(e,a),l=t.getUniformLocation(e,o.name);hE(o,l,this)}let s=[],r=[];for(let a of this.seq)a.type===t.SAMPLER_2D_SHADOW||a.type===t.SAMPLER_CUBE_SHADOW||a.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(a):r.push(a);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,n,s){let r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){let s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,a=e.length;r!==a;++r){let o=e[r],l=n[o.id];l.needsUpdate!==!1&&o.setValue(t,l.value,s)}}static seqWithValue(t,e){let n=[];for(let s=0,r=t.length;s!==r;++s){let a=t[s];a.id in e&&n.push(a)}return n}};function n_(i,t,e){let n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}var uE=37297,fE=0;function dE(i,t){let e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let a=s;a<r;a++){let o=a+1;n.push(`${o===t?">":" "} ${o}: ${e[a]}`)}return n.join(`
`)}var i_=new $t;function pE(i){ce._getMatrix(i_,ce.workingColorSpace,i);let t=`mat3( ${i_.elements.map(e=>e.toFixed(4))} )`;switch(ce.getTransfer(i)){case ka:return[t,"LinearTransferOETF"];case ve:return[t,"sRGBTransferOETF"];default:return Ut("WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function s_(i,t,e){let n=i.getShaderParameter(t,i.COMPILE_STATUS),r=(i.getShaderInfoLog(t)||"").trim();if(n&&r==="")return"";let a=/ERROR: 0:(\d+)/.exec(r);if(a){let o=parseInt(a[1]);return e.toUpperCase()+`

`+r+`

`+dE(i.getShaderSource(t),o)}else return r}function mE(i,t){let e=pE(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var gE={[Bf]:"Linear",[kf]:"Reinhard",[zf]:"Cineon",[Gf]:"ACESFilmic",[Hf]:"AgX",[Wf]:"Neutral",[Vf]:"Custom"};function _E(i,t){let e=gE[t];return e===void 0?(Ut("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var ch=new B;function yE(){ce.getLuminanceCoefficients(ch);let i=ch.x.toFixed(4),t=ch.y.toFixed(4),e=ch.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function xE(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(xo).join(`
`)}function vE(i){let t=[];for(let e in i){let n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function ME(i,t){let e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(t,s),a=r.name,o=1;r.type===i.FLOAT_MAT2&&(o=2),r.type===i.FLOAT_MAT3&&(o=3),r.type===i.FLOAT_MAT4&&(o=4),e[a]={type:r.type,location:i.getAttribLocation(t,a),locationSize:o}}return e}function xo(i){return i!==""}function r_(i,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function a_(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var bE=/^[ \t]*#include +<([\w\d./]+)>/gm;function _d(i){return i.replace(bE,wE)}function wE(i,t){let e=te[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return _d(e)}var SE=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function o_(i){return i.replace(SE,EE)}function EE(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function l_(i){let t=`precision ${i.precision} float;
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
#define LOW_PRECISION`),t}var AE={[Vs]:"SHADOWMAP_TYPE_PCF",[$r]:"SHADOWMAP_TYPE_VSM"};function TE(i){return AE[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var RE={[Yr]:"ENVMAP_MODE_REFRACTION"};function CE(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":RE[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var PE={[Mc]:"ENVMAP_BLENDING_MULTIPLY",[w0]:"ENVMAP_BLENDING_MIX",[S0]:"ENVMAP_BLENDING_ADD"};function IE(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":PE[i.combine]||"ENVMAP_BLENDING_NONE"}function LE(i,t,e,n){let s=i.getContext(),r=e.defines,a=e.vertexShader,o=e.fragmentShader,l=TE(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=CE(e),u=IE(e),f=xE(e),d=vE(r),m=s.createProgram(),_,p,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(xo).join(`
`),_.length>0&&(_+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(xo).join(`
`),p.length>0&&(p+=`
`)):(_=[l_(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(xo).join(`
`),p=[l_(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Ai?"#define TONE_MAPPING":"",e.toneMapping!==Ai?te.tonemapping_pars_fragment:"",e.toneMapping!==Ai?_E("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",te.colorspace_pars_fragment,mE("linearToOutputTexel",e.outputColorSpace),yE(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(xo).join(`
`)),a=_d(a),a=r_(a,e),a=a_(a,e),o=_d(o),o=r_(o,e),o=a_(o,e),a=o_(a),o=o_(o),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,_=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,p=["#define varying in",e.glslVersion===nd?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===nd?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let y=g+_+a,w=g+p+o,b=n_(s,s.VERTEX_SHADER,y),E=n_(s,s.FRAGMENT_SHADER,w);s.attachShader(m,b),s.attachShader(m,E),e.index0AttributeName!==void 0?s.bindAttribLocation(m,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(m,0,"position"),s.linkProgram(m);function T(L){if(i.debug.checkShaderErrors){let O=s.getProgramInfoLog(m)||"",H=s.getShaderInfoLog(b)||"",Z=s.getShaderInfoLog(E)||"",P=O.trim(),W=H.trim(),tt=Z.trim(),$=!0,at=!0;if(s.getProgramParameter(m,s.LINK_STATUS)===!1)if($=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,m,b,E);else{let X=s_(s,b,"vertex"),k=s_(s,E,"fragment");Ht("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(m,s.VALIDATE_STATUS)+`

Material Name: `+L.name+`
Material Type: `+L.type+`

Program Info Log: `+P+`
`+X+`
`+k)}else P!==""?Ut("WebGLProgram: Program Info Log:",P):(W===""||tt==="")&&(at=!1);at&&(L.diagnostics={runnable:$,programLog:P,vertexShader:{log:W,prefix:_},fragmentShader:{log:tt,prefix:p}})}s.deleteShader(b),s.deleteShader(E),x=new Jr(s,m),A=ME(s,m)}let x;this.getUniforms=function(){return x===void 0&&T(this),x};let A;this.getAttributes=function(){return A===void 0&&T(this),A};let F=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return F===!1&&(F=s.getProgramParameter(m,uE)),F},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(m),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=fE++,this.cacheKey=t,this.usedTimes=1,this.program=m,this.vertexShader=b,this.fragmentShader=E,this}var NE=0,yd=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,n){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new xd(t),e.set(t,n)),n}},xd=class{constructor(t){this.id=NE++,this.code=t,this.usedTimes=0}};function DE(i){return i===ys||i===go||i===_o}function OE(i,t,e,n,s,r){let a=new Br,o=new yd,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(x){return l.add(x),x===0?"uv":`uv${x}`}function m(x,A,F,L,O,H){let Z=L.fog,P=O.geometry,W=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?L.environment:null,tt=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,$=t.get(x.envMap||W,tt),at=f[x.type],X=n.precision;x.precision!==null&&(X=n.getMaxPrecision(x.precision),X!==x.precision&&Ut("WebGLProgram.getParameters:",x.precision,"not supported, using",X,"instead."));let k=P.morphAttributes.position||P.morphAttributes.normal||P.morphAttributes.color,it=k!==void 0?k.length:0,Tt=0;P.morphAttributes.position!==void 0&&(Tt=1),P.morphAttributes.normal!==void 0&&(Tt=2),P.morphAttributes.color!==void 0&&(Tt=3);let kt,et,pt,_t;if(at){let bt=Ri[at];kt=bt.vertexShader,et=bt.fragmentShader}else{kt=x.vertexShader,et=x.fragmentShader;let bt=o.getVertexShaderStage(x),me=o.getFragmentShaderStage(x);o.update(x,bt,me),pt=bt.id,_t=me.id}let Nt=i.getRenderTarget(),lt=i.state.buffers.depth.getReversed(),At=O.isInstancedMesh===!0,ae=O.isBatchedMesh===!0,Ft=!!x.map,ee=!!x.matcap,_e=!!$,Qt=_e&&$.isPMREMTexture===!0,Ge=!!x.aoMap,Ue=!!x.lightMap,fn=!!x.bumpMap&&x.wireframe===!1,ye=!!x.normalMap,oe=!!x.displacementMap,Be=!!x.emissiveMap,Mn=!!x.metalnessMap,pn=!!x.roughnessMap,ze=x.anisotropy>0,D=x.clearcoat>0,bn=x.diffuseRoughness>0,pe=x.dispersion>0,Ae=x.retroreflectivity>0,Mt=x.iridescence>0,ke=x.sheen>0,Bt=x.transmission>0,Gt=ze&&!!x.anisotropyMap,C=D&&!!x.clearcoatMap,M=D&&!!x.clearcoatNormalMap,G=D&&!!x.clearcoatRoughnessMap,ot=bn&&!!x.diffuseRoughnessMap,st=Mt&&!!x.iridescenceMap,ut=Mt&&!!x.iridescenceThicknessMap,yt=ke&&!!x.sheenColorMap,j=ke&&!!x.sheenRoughnessMap,Q=!!x.specularMap,ft=!!x.specularColorMap,I=!!x.specularIntensityMap,nt=Bt&&!!x.transmissionMap,J=Bt&&!!x.thicknessMap,mt=!!x.gradientMap,ht=!!x.alphaMap,dt=x.alphaTest>0,Dt=!!x.alphaHash,Kt=!!x.extensions,ct=Ai;x.toneMapped&&(Nt===null||Nt.isXRRenderTarget===!0)&&(ct=i.toneMapping);let Ot=Qt?$.isCompressedCubeTexture?$.image[0].mipmaps:$.mipmaps:null,Zt={shaderID:at,shaderType:x.type,shaderName:x.name,vertexShader:kt,fragmentShader:et,defines:x.defines,customVertexShaderID:pt,customFragmentShaderID:_t,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:X,batching:ae,batchingColor:ae&&O._colorsTexture!==null,instancing:At,instancingColor:At&&O.instanceColor!==null,instancingMorph:At&&O.morphTexture!==null,outputColorSpace:Nt===null?i.outputColorSpace:Nt.isXRRenderTarget===!0?Nt.texture.colorSpace:ce.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:Ft,matcap:ee,envMap:_e,envMapMode:_e&&$.mapping,envMapPMREM:Qt,envMapMaxLod:Qt?Ot.length-1:null,envMapSize:Qt?Ot[0].width:null,aoMap:Ge,lightMap:Ue,bumpMap:fn,normalMap:ye,displacementMap:oe,emissiveMap:Be,normalMapObjectSpace:ye&&x.normalMapType===R0,normalMapTangentSpace:ye&&x.normalMapType===oh,packedNormalMap:ye&&x.normalMapType===oh&&DE(x.normalMap.format),metalnessMap:Mn,roughnessMap:pn,anisotropy:ze,anisotropyMap:Gt,clearcoat:D,clearcoatMap:C,clearcoatNormalMap:M,clearcoatRoughnessMap:G,diffuseRoughness:bn,diffuseRoughnessMap:ot,dispersion:pe,retroreflection:Ae,iridescence:Mt,iridescenceMap:st,iridescenceThicknessMap:ut,sheen:ke,sheenColorMap:yt,sheenRoughnessMap:j,specularMap:Q,specularColorMap:ft,specularIntensityMap:I,transmission:Bt,transmissionMap:nt,thicknessMap:J,gradientMap:mt,opaque:x.transparent===!1&&x.blending===qr&&x.alphaToCoverage===!1,alphaMap:ht,alphaTest:dt,alphaHash:Dt,combine:x.combine,mapUv:Ft&&d(x.map.channel),aoMapUv:Ge&&d(x.aoMap.channel),lightMapUv:Ue&&d(x.lightMap.channel),bumpMapUv:fn&&d(x.bumpMap.channel),normalMapUv:ye&&d(x.normalMap.channel),displacementMapUv:oe&&d(x.displacementMap.channel),emissiveMapUv:Be&&d(x.emissiveMap.channel),metalnessMapUv:Mn&&d(x.metalnessMap.channel),roughnessMapUv:pn&&d(x.roughnessMap.channel),anisotropyMapUv:Gt&&d(x.anisotropyMap.channel),clearcoatMapUv:C&&d(x.clearcoatMap.channel),clearcoatNormalMapUv:M&&d(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:G&&d(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ot&&d(x.diffuseRoughnessMap.channel),iridescenceMapUv:st&&d(x.iridescenceMap.channel),iridescenceThicknessMapUv:ut&&d(x.iridescenceThicknessMap.channel),sheenColorMapUv:yt&&d(x.sheenColorMap.channel),sheenRoughnessMapUv:j&&d(x.sheenRoughnessMap.channel),specularMapUv:Q&&d(x.specularMap.channel),specularColorMapUv:ft&&d(x.specularColorMap.channel),specularIntensityMapUv:I&&d(x.specularIntensityMap.channel),transmissionMapUv:nt&&d(x.transmissionMap.channel),thicknessMapUv:J&&d(x.thicknessMap.channel),alphaMapUv:ht&&d(x.alphaMap.channel),vertexTangents:!!P.attributes.tangent&&(ye||ze),vertexNormals:!!P.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!P.attributes.color&&P.attributes.color.itemSize===4,pointsUvs:O.isPoints===!0&&!!P.attributes.uv&&(Ft||ht),fog:!!Z,useFog:x.fog===!0,fogExp2:!!Z&&Z.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||P.attributes.normal===void 0&&ye===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:lt,skinning:O.isSkinnedMesh===!0,hasPositionAttribute:P.attributes.position!==void 0,morphTargets:P.morphAttributes.position!==void 0,morphNormals:P.morphAttributes.normal!==void 0,morphColors:P.morphAttributes.color!==void 0,morphTargetsCount:it,morphTextureStride:Tt,numSunLights:A.sun.length,numDirLights:A.directional.length,numPointLights:A.point.length,numSpotLights:A.spot.length,numSpotLightMaps:A.spotLightMap.length,numRectAreaLights:A.rectArea.length,numHemiLights:A.hemi.length,numSunLightShadows:A.sunShadowMap.length,numDirLightShadows:A.directionalShadowMap.length,numPointLightShadows:A.pointShadowMap.length,numSpotLightShadows:A.spotShadowMap.length,numSpotLightShadowsWithMaps:A.numSpotLightShadowsWithMaps,numLightProbes:A.numLightProbes,numLightProbeGrids:H.filter(bt=>bt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:i.shadowMap.enabled&&F.length>0,shadowMapType:i.shadowMap.type,toneMapping:ct,decodeVideoTexture:Ft&&x.map.isVideoTexture===!0&&ce.getTransfer(x.map.colorSpace)===ve,decodeVideoTextureEmissive:Be&&x.emissiveMap.isVideoTexture===!0&&ce.getTransfer(x.emissiveMap.colorSpace)===ve,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===Ei,flipSided:x.side===In,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:Kt&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Kt&&x.extensions.multiDraw===!0||ae)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return Zt.vertexUv1s=l.has(1),Zt.vertexUv2s=l.has(2),Zt.vertexUv3s=l.has(3),l.clear(),Zt}function _(x){let A=[];if(x.shaderID?A.push(x.shaderID):(A.push(x.customVertexShaderID),A.push(x.customFragmentShaderID)),x.defines!==void 0)for(let F in x.defines)A.push(F),A.push(x.defines[F]);return x.isRawShaderMaterial===!1&&(p(A,x),g(A,x),A.push(i.outputColorSpace)),A.push(x.customProgramCacheKey),A.join()}function p(x,A){x.push(A.precision),x.push(A.outputColorSpace),x.push(A.envMapMode),x.push(A.envMapPMREM),x.push(A.envMapMaxLod),x.push(A.envMapSize),x.push(A.mapUv),x.push(A.alphaMapUv),x.push(A.lightMapUv),x.push(A.aoMapUv),x.push(A.bumpMapUv),x.push(A.normalMapUv),x.push(A.displacementMapUv),x.push(A.emissiveMapUv),x.push(A.metalnessMapUv),x.push(A.roughnessMapUv),x.push(A.anisotropyMapUv),x.push(A.clearcoatMapUv),x.push(A.clearcoatNormalMapUv),x.push(A.clearcoatRoughnessMapUv),x.push(A.diffuseRoughnessMapUv),x.push(A.iridescenceMapUv),x.push(A.iridescenceThicknessMapUv),x.push(A.sheenColorMapUv),x.push(A.sheenRoughnessMapUv),x.push(A.specularMapUv),x.push(A.specularColorMapUv),x.push(A.specularIntensityMapUv),x.push(A.transmissionMapUv),x.push(A.thicknessMapUv),x.push(A.combine),x.push(A.fogExp2),x.push(A.sizeAttenuation),x.push(A.morphTargetsCount),x.push(A.numSunLights),x.push(A.numDirLights),x.push(A.numPointLights),x.push(A.numSpotLights),x.push(A.numSpotLightMaps),x.push(A.numHemiLights),x.push(A.numRectAreaLights),x.push(A.numSunLightShadows),x.push(A.numDirLightShadows),x.push(A.numPointLightShadows),x.push(A.numSpotLightShadows),x.push(A.numSpotLightShadowsWithMaps),x.push(A.numLightProbes),x.push(A.numLightProbeGrids),x.push(A.shadowMapType),x.push(A.toneMapping),x.push(A.numClippingPlanes),x.push(A.numClipIntersection),x.push(A.depthPacking)}function g(x,A){a.disableAll(),A.instancing&&a.enable(0),A.instancingColor&&a.enable(1),A.instancingMorph&&a.enable(2),A.matcap&&a.enable(3),A.envMap&&a.enable(4),A.normalMapObjectSpace&&a.enable(5),A.normalMapTangentSpace&&a.enable(6),A.clearcoat&&a.enable(7),A.iridescence&&a.enable(8),A.alphaTest&&a.enable(9),A.vertexColors&&a.enable(10),A.vertexAlphas&&a.enable(11),A.vertexUv1s&&a.enable(12),A.vertexUv2s&&a.enable(13),A.vertexUv3s&&a.enable(14),A.vertexTangents&&a.enable(15),A.anisotropy&&a.enable(16),A.alphaHash&&a.enable(17),A.batching&&a.enable(18),A.dispersion&&a.enable(19),A.retroreflection&&a.enable(24),A.diffuseRoughness&&a.enable(25),A.batchingColor&&a.enable(20),A.gradientMap&&a.enable(21),A.packedNormalMap&&a.enable(22),A.vertexNormals&&a.enable(23),x.push(a.mask),a.disableAll(),A.fog&&a.enable(0),A.useFog&&a.enable(1),A.flatShading&&a.enable(2),A.logarithmicDepthBuffer&&a.enable(3),A.reversedDepthBuffer&&a.enable(4),A.skinning&&a.enable(5),A.morphTargets&&a.enable(6),A.morphNormals&&a.enable(7),A.morphColors&&a.enable(8),A.premultipliedAlpha&&a.enable(9),A.shadowMapEnabled&&a.enable(10),A.doubleSided&&a.enable(11),A.flipSided&&a.enable(12),A.useDepthPacking&&a.enable(13),A.dithering&&a.enable(14),A.transmission&&a.enable(15),A.sheen&&a.enable(16),A.opaque&&a.enable(17),A.pointsUvs&&a.enable(18),A.decodeVideoTexture&&a.enable(19),A.decodeVideoTextureEmissive&&a.enable(20),A.alphaToCoverage&&a.enable(21),A.numLightProbeGrids>0&&a.enable(22),A.hasPositionAttribute&&a.enable(23),x.push(a.mask)}function y(x){let A=f[x.type],F;if(A){let L=Ri[A];F=H0.clone(L.uniforms)}else F=x.uniforms;return F}function w(x,A){let F=h.get(A);return F!==void 0?++F.usedTimes:(F=new LE(i,A,x,s),c.push(F),h.set(A,F)),F}function b(x){if(--x.usedTimes===0){let A=c.indexOf(x);c[A]=c[c.length-1],c.pop(),h.delete(x.cacheKey),x.destroy()}}function E(x){o.remove(x)}function T(){o.dispose()}return{getParameters:m,getProgramCacheKey:_,getUniforms:y,acquireProgram:w,releaseProgram:b,releaseShaderCache:E,programs:c,dispose:T}}function UE(){let i=new WeakMap;function t(a){return i.has(a)}function e(a){let o=i.get(a);return o===void 0&&(o={},i.set(a,o)),o}function n(a){i.delete(a)}function s(a,o,l){i.get(a)[o]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function FE(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.materialVariant!==t.materialVariant?i.materialVariant-t.materialVariant:i.z!==t.z?i.z-t.z:i.id-t.id}function c_(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function h_(){let i=[],t=0,e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function a(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function o(f,d,m,_,p,g){let y=i[t];return y===void 0?(y={id:f.id,object:f,geometry:d,material:m,materialVariant:a(f),groupOrder:_,renderOrder:f.renderOrder,z:p,group:g},i[t]=y):(y.id=f.id,y.object=f,y.geometry=d,y.material=m,y.materialVariant=a(f),y.groupOrder=_,y.renderOrder=f.renderOrder,y.z=p,y.group=g),t++,y}function l(f,d,m,_,p,g,y){y.reversedDepth===!0&&(p=-p);let w=o(f,d,m,_,p,g);m.transmission>0?n.push(w):m.transparent===!0?s.push(w):e.push(w)}function c(f,d,m,_,p,g){let y=o(f,d,m,_,p,g);m.transmission>0?n.unshift(y):m.transparent===!0?s.unshift(y):e.unshift(y)}function h(f,d){e.length>1&&e.sort(f||FE),n.length>1&&n.sort(d||c_),s.length>1&&s.sort(d||c_)}function u(){for(let f=t,d=i.length;f<d;f++){let m=i[f];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function BE(){let i=new WeakMap;function t(n,s){let r=i.get(n),a;return r===void 0?(a=new h_,i.set(n,[a])):s>=r.length?(a=new h_,r.push(a)):a=r[s],a}function e(){i=new WeakMap}return{get:t,dispose:e}}function kE(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new B,color:new Jt};break;case"SpotLight":e={position:new B,direction:new B,color:new Jt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new B,color:new Jt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new B,skyColor:new Jt,groundColor:new Jt};break;case"RectAreaLight":e={color:new Jt,position:new B,halfWidth:new B,halfHeight:new B};break}return i[t.id]=e,e}}}function zE(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new zt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new zt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new zt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}var GE=0;function VE(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function HE(i){let t=new kE,e=zE(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new B);let s=new B,r=new re,a=new re;function o(c){let h=0,u=0,f=0;for(let H=0;H<9;H++)n.probe[H].set(0,0,0);let d=0,m=0,_=0,p=0,g=0,y=0,w=0,b=0,E=0,T=0,x=0,A=0,F=0,L=0;c.sort(VE);for(let H=0,Z=c.length;H<Z;H++){let P=c[H],W=P.color,tt=P.intensity,$=P.distance,at=null;if(P.shadow&&P.shadow.map&&(P.shadow.map.texture.format===ys?at=P.shadow.map.texture:at=P.shadow.map.depthTexture||P.shadow.map.texture),P.isAmbientLight)h+=W.r*tt,u+=W.g*tt,f+=W.b*tt;else if(P.isLightProbe){for(let X=0;X<9;X++)n.probe[X].addScaledVector(P.sh.coefficients[X],tt);L++}else if(P.isSunLight){let X=t.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let k=P.shadow,it=e.get(P);it.shadowIntensity=k.intensity,it.shadowBias=k.bias,it.shadowNormalBias=k.normalBias,it.shadowRadius=k.radius,it.shadowMapSize.copy(k.mapSize).multiply(k.getFrameExtents()),n.sunShadow[m]=it,n.sunShadowMap[m]=at;let Tt=k.getViewportCount();for(let kt=0;kt<Tt;kt++)n.sunShadowMatrix[_+kt]=k.getMatrix(kt),n.sunShadowCascade[_+kt]=k._cascadeData[kt];_+=Tt,m++}n.sun[d]=X,d++}else if(P.isDirectionalLight){let X=t.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let k=P.shadow,it=e.get(P);it.shadowIntensity=k.intensity,it.shadowBias=k.bias,it.shadowNormalBias=k.normalBias,it.shadowRadius=k.radius,it.shadowMapSize=k.mapSize,n.directionalShadow[p]=it,n.directionalShadowMap[p]=at,n.directionalShadowMatrix[p]=P.shadow.matrix,E++}n.directional[p]=X,p++}else if(P.isSpotLight){let X=t.get(P);X.position.setFromMatrixPosition(P.matrixWorld),X.color.copy(W).multiplyScalar(tt),X.distance=$,X.coneCos=Math.cos(P.angle),X.penumbraCos=Math.cos(P.angle*(1-P.penumbra)),X.decay=P.decay,n.spot[y]=X;let k=P.shadow;if(P.map&&(n.spotLightMap[A]=P.map,A++,k.updateMatrices(P),P.castShadow&&F++),n.spotLightMatrix[y]=k.matrix,P.castShadow){let it=e.get(P);it.shadowIntensity=k.intensity,it.shadowBias=k.bias,it.shadowNormalBias=k.normalBias,it.shadowRadius=k.radius,it.shadowMapSize=k.mapSize,n.spotShadow[y]=it,n.spotShadowMap[y]=at,x++}y++}else if(P.isRectAreaLight){let X=t.get(P);X.color.copy(W).multiplyScalar(tt),X.halfWidth.set(P.width*.5,0,0),X.halfHeight.set(0,P.height*.5,0),n.rectArea[w]=X,w++}else if(P.isPointLight){let X=t.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),X.distance=P.distance,X.decay=P.decay,P.castShadow){let k=P.shadow,it=e.get(P);it.shadowIntensity=k.intensity,it.shadowBias=k.bias,it.shadowNormalBias=k.normalBias,it.shadowRadius=k.radius,it.shadowMapSize=k.mapSize,it.shadowCameraNear=k.camera.near,it.shadowCameraFar=k.camera.far,n.pointShadow[g]=it,n.pointShadowMap[g]=at,n.pointShadowMatrix[g]=P.shadow.matrix,T++}n.point[g]=X,g++}else if(P.isHemisphereLight){let X=t.get(P);X.skyColor.copy(P.color).multiplyScalar(tt),X.groundColor.copy(P.groundColor).multiplyScalar(tt),n.hemi[b]=X,b++}}w>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=St.LTC_FLOAT_1,n.rectAreaLTC2=St.LTC_FLOAT_2):(n.rectAreaLTC1=St.LTC_HALF_1,n.rectAreaLTC2=St.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=f;let O=n.hash;(O.sunLength!==d||O.directionalLength!==p||O.pointLength!==g||O.spotLength!==y||O.rectAreaLength!==w||O.hemiLength!==b||O.numSunShadows!==m||O.numDirectionalShadows!==E||O.numPointShadows!==T||O.numSpotShadows!==x||O.numSpotMaps!==A||O.numLightProbes!==L)&&(n.sun.length=d,n.directional.length=p,n.spot.length=y,n.rectArea.length=w,n.point.length=g,n.hemi.length=b,n.sunShadow.length=m,n.sunShadowMap.length=m,n.sunShadowMatrix.length=_,n.sunShadowCascade.length=_,n.directionalShadow.length=E,n.directionalShadowMap.length=E,n.directionalShadowMatrix.length=E,n.pointShadow.length=T,n.pointShadowMap.length=T,n.pointShadowMatrix.length=T,n.spotShadow.length=x,n.spotShadowMap.length=x,n.spotLightMatrix.length=x+A-F,n.spotLightMap.length=A,n.numSpotLightShadowsWithMaps=F,n.numLightProbes=L,O.sunLength=d,O.directionalLength=p,O.pointLength=g,O.spotLength=y,O.rectAreaLength=w,O.hemiLength=b,O.numSunShadows=m,O.numDirectionalShadows=E,O.numPointShadows=T,O.numSpotShadows=x,O.numSpotMaps=A,O.numLightProbes=L,n.version=GE++)}function l(c,h){let u=0,f=0,d=0,m=0,_=0,p=0,g=h.matrixWorldInverse;for(let y=0,w=c.length;y<w;y++){let b=c[y];if(b.isSunLight){let E=n.sun[u];E.direction.setFromMatrixPosition(b.matrixWorld),E.direction.transformDirection(g),u++}else if(b.isDirectionalLight){let E=n.directional[f];E.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(g),f++}else if(b.isSpotLight){let E=n.spot[m];E.position.setFromMatrixPosition(b.matrixWorld),E.position.applyMatrix4(g),E.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(g),m++}else if(b.isRectAreaLight){let E=n.rectArea[_];E.position.setFromMatrixPosition(b.matrixWorld),E.position.applyMatrix4(g),a.identity(),r.copy(b.matrixWorld),r.premultiply(g),a.extractRotation(r),E.halfWidth.set(b.width*.5,0,0),E.halfHeight.set(0,b.height*.5,0),E.halfWidth.applyMatrix4(a),E.halfHeight.applyMatrix4(a),_++}else if(b.isPointLight){let E=n.point[d];E.position.setFromMatrixPosition(b.matrixWorld),E.position.applyMatrix4(g),d++}else if(b.isHemisphereLight){let E=n.hemi[p];E.direction.setFromMatrixPosition(b.matrixWorld),E.direction.transformDirection(g),p++}}}return{setup:o,setupView:l,state:n}}function u_(i){let t=new HE(i),e=[],n=[],s=[];function r(u){h.camera=u,e.length=0,n.length=0,s.length=0}function a(u){u.isLightProbeGrid?s.push(u):e.push(u)}function o(u){n.push(u)}function l(){t.setup(e),s.sort((u,f)=>u.priority-f.priority||u.id-f.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:a,pushShadow:o}}function WE(i){let t=new WeakMap;function e(s,r=0){let a=t.get(s),o;return a===void 0?(o=new u_(i),t.set(s,[o])):r>=a.length?(o=new u_(i),a.push(o)):o=a[r],o}function n(){t=new WeakMap}return{get:e,dispose:n}}var XE=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,$E=`uniform sampler2D shadow_pass;
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
}`,qE=[new B(1,0,0),new B(-1,0,0),new B(0,1,0),new B(0,-1,0),new B(0,0,1),new B(0,0,-1)],YE=[new B(0,-1,0),new B(0,-1,0),new B(0,0,1),new B(0,0,-1),new B(0,-1,0),new B(0,-1,0)],f_=new re,yo=new B,dd=new B;function ZE(i,t,e){let n=new hs,s=new zt,r=new zt,a=new be,o=new oc,l=new lc,c={},h=e.maxTextureSize,u={[_s]:In,[In]:_s,[Ei]:Ei},f=new Si({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new zt},radius:{value:4}},vertexShader:XE,fragmentShader:$E}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let m=new Pn;m.setAttribute("position",new cn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new On(m,f),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Vs;let g=this.type;this.render=function(T,x,A){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||T.length===0)return;this.type===s0&&(Ut("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Vs);let F=i.getRenderTarget(),L=i.getActiveCubeFace(),O=i.getActiveMipmapLevel(),H=i.state;H.setBlending(Hs),H.buffers.depth.getReversed()===!0?H.buffers.color.setClear(0,0,0,0):H.buffers.color.setClear(1,1,1,1),H.buffers.depth.setTest(!0),H.setScissorTest(!1);let Z=g!==this.type;Z&&x.traverse(function(P){P.material&&(Array.isArray(P.material)?P.material.forEach(W=>W.needsUpdate=!0):P.material.needsUpdate=!0)});for(let P=0,W=T.length;P<W;P++){let tt=T[P],$=tt.shadow;if($===void 0){Ut("WebGLShadowMap:",tt,"has no shadow.");continue}if($.autoUpdate===!1&&$.needsUpdate===!1)continue;s.copy($.mapSize);let at=$.getFrameExtents();s.multiply(at),r.copy($.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/at.x),s.x=r.x*at.x,$.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/at.y),s.y=r.y*at.y,$.mapSize.y=r.y));let X=i.state.buffers.depth.getReversed();if($.camera._reversedDepth=X,$.map===null||Z===!0){if($.map!==null&&($.map.depthTexture!==null&&($.map.depthTexture.dispose(),$.map.depthTexture=null),$.map.dispose()),this.type===$r){if(tt.isPointLight){Ut("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}$.map=new $n(s.x,s.y,{format:ys,type:mi,minFilter:Cn,magFilter:Cn,generateMipmaps:!1}),$.map.texture.name=tt.name+".shadowMap",$.map.depthTexture=new $i(s.x,s.y,si),$.map.depthTexture.name=tt.name+".shadowMapDepth",$.map.depthTexture.format=Gi,$.map.depthTexture.compareFunction=null,$.map.depthTexture.minFilter=hn,$.map.depthTexture.magFilter=hn}else tt.isPointLight?($.map=new vo(s.x),$.map.depthTexture=new Ka(s.x,pi)):($.map=new $n(s.x,s.y),$.map.depthTexture=new $i(s.x,s.y,pi)),$.map.depthTexture.name=tt.name+".shadowMap",$.map.depthTexture.format=Gi,this.type===Vs?($.map.depthTexture.compareFunction=X?td:Qf,$.map.depthTexture.minFilter=Cn,$.map.depthTexture.magFilter=Cn):($.map.depthTexture.compareFunction=null,$.map.depthTexture.minFilter=hn,$.map.depthTexture.magFilter=hn);$.camera.updateProjectionMatrix()}$.map.isWebGLCubeRenderTarget!==!0&&($.map.width!==s.x||$.map.height!==s.y)&&$.map.setSize(s.x,s.y);let k=$.map.isWebGLCubeRenderTarget?6:$.getViewportCount();tt.isPointLight!==!0&&$.updateMatrices(tt,A);let it=($.camera.layers.mask&4294967294)!==0?$.camera.layers:A.layers;for(let Tt=0;Tt<k;Tt++){let kt=$.getCamera(Tt);if(tt.isPointLight){let et=$.camera,pt=$.matrix,_t=tt.distance||et.far;_t!==et.far&&(et.far=_t,et.updateProjectionMatrix()),yo.setFromMatrixPosition(tt.matrixWorld),et.position.copy(yo),dd.copy(et.position),dd.add(qE[Tt]),et.up.copy(YE[Tt]),et.lookAt(dd),et.updateMatrixWorld(),pt.makeTranslation(-yo.x,-yo.y,-yo.z),f_.multiplyMatrices(et.projectionMatrix,et.matrixWorldInverse),$._frustum.setFromProjectionMatrix(f_,et.coordinateSystem,et.reversedDepth)}if($.map.isWebGLCubeRenderTarget)i.setRenderTarget($.map,Tt),i.clear();else{Tt===0&&(i.setRenderTarget($.map),i.clear());let et=$.getViewport(Tt);a.set(r.x*et.x,r.y*et.y,r.x*et.z,r.y*et.w),H.viewport(a)}n=$.getFrustum(Tt),b(x,A,kt,tt,it,this.type)}$.isPointLightShadow!==!0&&this.type===$r&&y($,A),$.needsUpdate=!1}g=this.type,p.needsUpdate=!1,i.setRenderTarget(F,L,O)};function y(T,x){let A=t.update(_);f.defines.VSM_SAMPLES!==T.blurSamples&&(f.defines.VSM_SAMPLES=T.blurSamples,d.defines.VSM_SAMPLES=T.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),T.mapPass===null?T.mapPass=new $n(s.x,s.y,{format:ys,type:mi}):(T.mapPass.width!==T.map.width||T.mapPass.height!==T.map.height)&&T.mapPass.setSize(T.map.width,T.map.height),f.uniforms.shadow_pass.value=T.map.depthTexture,f.uniforms.resolution.value.set(T.map.width,T.map.height),f.uniforms.radius.value=T.radius,i.setRenderTarget(T.mapPass),i.clear(),i.renderBufferDirect(x,null,A,f,_,null),d.uniforms.shadow_pass.value=T.mapPass.texture,d.uniforms.resolution.value.set(T.map.width,T.map.height),d.uniforms.radius.value=T.radius,i.setRenderTarget(T.map),i.clear(),i.renderBufferDirect(x,null,A,d,_,null)}function w(T,x,A,F){let L=null,O=A.isPointLight===!0?T.customDistanceMaterial:T.customDepthMaterial;if(O!==void 0)L=O;else if(L=A.isPointLight===!0?l:o,i.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let H=L.uuid,Z=x.uuid,P=c[H];P===void 0&&(P={},c[H]=P);let W=P[Z];W===void 0&&(W=L.clone(),P[Z]=W,x.addEventListener("dispose",E)),L=W}if(L.visible=x.visible,L.wireframe=x.wireframe,F===$r?L.side=x.shadowSide!==null?x.shadowSide:x.side:L.side=x.shadowSide!==null?x.shadowSide:u[x.side],L.alphaMap=x.alphaMap,L.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,L.map=x.map,L.clipShadows=x.clipShadows,L.clippingPlanes=x.clippingPlanes,L.clipIntersection=x.clipIntersection,L.displacementMap=x.displacementMap,L.displacementScale=x.displacementScale,L.displacementBias=x.displacementBias,L.wireframeLinewidth=x.wireframeLinewidth,L.linewidth=x.linewidth,A.isPointLight===!0&&L.isMeshDistanceMaterial===!0){let H=i.properties.get(L);H.light=A}return L}function b(T,x,A,F,L,O){if(T.visible===!1)return;if(T.layers.test(L)&&(T.isMesh||T.isLine||T.isPoints)&&(T.castShadow||T.receiveShadow&&O===$r)&&(!T.frustumCulled||T.intersectsFrustum(n))){T.modelViewMatrix.multiplyMatrices(A.matrixWorldInverse,T.matrixWorld);let P=t.update(T),W=T.material;if(Array.isArray(W)){let tt=P.groups;for(let $=0,at=tt.length;$<at;$++){let X=tt[$],k=W[X.materialIndex];if(k&&k.visible){let it=w(T,k,F,O);T.onBeforeShadow(i,T,x,A,P,it,X),i.renderBufferDirect(A,null,P,it,T,X),T.onAfterShadow(i,T,x,A,P,it,X)}}}else if(W.visible){let tt=w(T,W,F,O);T.onBeforeShadow(i,T,x,A,P,tt,null),i.renderBufferDirect(A,null,P,tt,T,null),T.onAfterShadow(i,T,x,A,P,tt,null)}}let Z=T.children;for(let P=0,W=Z.length;P<W;P++)b(Z[P],x,A,F,L,O)}function E(T){T.target.removeEventListener("dispose",E);for(let A in c){let F=c[A],L=T.target.uuid;L in F&&(F[L].dispose(),delete F[L])}}}function JE(i,t){function e(){let I=!1,nt=new be,J=null,mt=new be(0,0,0,0);return{setMask:function(ht){J!==ht&&!I&&(i.colorMask(ht,ht,ht,ht),J=ht)},setLocked:function(ht){I=ht},setClear:function(ht,dt,Dt,Kt,ct){ct===!0&&(ht*=Kt,dt*=Kt,Dt*=Kt),nt.set(ht,dt,Dt,Kt),mt.equals(nt)===!1&&(i.clearColor(ht,dt,Dt,Kt),mt.copy(nt))},reset:function(){I=!1,J=null,mt.set(-1,0,0,0)}}}function n(){let I=!1,nt=!1,J=null,mt=null,ht=null;return{setReversed:function(dt){if(nt!==dt){let Dt=t.get("EXT_clip_control");dt?Dt.clipControlEXT(Dt.LOWER_LEFT_EXT,Dt.ZERO_TO_ONE_EXT):Dt.clipControlEXT(Dt.LOWER_LEFT_EXT,Dt.NEGATIVE_ONE_TO_ONE_EXT),nt=dt;let Kt=ht;ht=null,this.setClear(Kt)}},getReversed:function(){return nt},setTest:function(dt){dt?lt(i.DEPTH_TEST):At(i.DEPTH_TEST)},setMask:function(dt){J!==dt&&!I&&(i.depthMask(dt),J=dt)},setFunc:function(dt){if(nt&&(dt=k0[dt]),mt!==dt){switch(dt){case Wl:i.depthFunc(i.NEVER);break;case Xl:i.depthFunc(i.ALWAYS);break;case $l:i.depthFunc(i.LESS);break;case Nr:i.depthFunc(i.LEQUAL);break;case ql:i.depthFunc(i.EQUAL);break;case Yl:i.depthFunc(i.GEQUAL);break;case Zl:i.depthFunc(i.GREATER);break;case Jl:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}mt=dt}},setLocked:function(dt){I=dt},setClear:function(dt){ht!==dt&&(ht=dt,nt&&(dt=1-dt),i.clearDepth(dt))},reset:function(){I=!1,J=null,mt=null,ht=null,nt=!1}}}function s(){let I=!1,nt=null,J=null,mt=null,ht=null,dt=null,Dt=null,Kt=null,ct=null;return{setTest:function(Ot){I||(Ot?lt(i.STENCIL_TEST):At(i.STENCIL_TEST))},setMask:function(Ot){nt!==Ot&&!I&&(i.stencilMask(Ot),nt=Ot)},setFunc:function(Ot,Zt,bt){(J!==Ot||mt!==Zt||ht!==bt)&&(i.stencilFunc(Ot,Zt,bt),J=Ot,mt=Zt,ht=bt)},setOp:function(Ot,Zt,bt){(dt!==Ot||Dt!==Zt||Kt!==bt)&&(i.stencilOp(Ot,Zt,bt),dt=Ot,Dt=Zt,Kt=bt)},setLocked:function(Ot){I=Ot},setClear:function(Ot){ct!==Ot&&(i.clearStencil(Ot),ct=Ot)},reset:function(){I=!1,nt=null,J=null,mt=null,ht=null,dt=null,Dt=null,Kt=null,ct=null}}}let r=new e,a=new n,o=new s,l={},c=new WeakMap,h={},u={},f={},d=new WeakMap,m=[],_=null,p=!1,g=null,y=null,w=null,b=null,E=null,T=null,x=null,A=new Jt(0,0,0),F=0,L=!1,O=null,H=null,Z=null,P=null,W=null,tt=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),$=!1,at=0,X=i.getParameter(i.VERSION);X.indexOf("WebGL")!==-1?(at=parseFloat(/^WebGL (\d)/.exec(X)[1]),$=at>=1):X.indexOf("OpenGL ES")!==-1&&(at=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),$=at>=2);let k=null,it={},Tt=i.getParameter(i.SCISSOR_BOX),kt=i.getParameter(i.VIEWPORT),et=new be().fromArray(Tt),pt=new be().fromArray(kt);function _t(I,nt,J,mt){let ht=new Uint8Array(4),dt=i.createTexture();i.bindTexture(I,dt),i.texParameteri(I,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(I,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Dt=0;Dt<J;Dt++)I===i.TEXTURE_3D||I===i.TEXTURE_2D_ARRAY?i.texImage3D(nt,0,i.RGBA,1,1,mt,0,i.RGBA,i.UNSIGNED_BYTE,ht):i.texImage2D(nt+Dt,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,ht);return dt}let Nt={};Nt[i.TEXTURE_2D]=_t(i.TEXTURE_2D,i.TEXTURE_2D,1),Nt[i.TEXTURE_CUBE_MAP]=_t(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Nt[i.TEXTURE_2D_ARRAY]=_t(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Nt[i.TEXTURE_3D]=_t(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),a.setClear(1),o.setClear(0),lt(i.DEPTH_TEST),a.setFunc(Nr),fn(!1),ye(Lf),lt(i.CULL_FACE),Ge(Hs);function lt(I){h[I]!==!0&&(i.enable(I),h[I]=!0)}function At(I){h[I]!==!1&&(i.disable(I),h[I]=!1)}function ae(I,nt){return f[I]!==nt?(i.bindFramebuffer(I,nt),f[I]=nt,I===i.DRAW_FRAMEBUFFER&&(f[i.FRAMEBUFFER]=nt),I===i.FRAMEBUFFER&&(f[i.DRAW_FRAMEBUFFER]=nt),!0):!1}function Ft(I,nt){let J=m,mt=!1;if(I){J=d.get(nt),J===void 0&&(J=[],d.set(nt,J));let ht=I.textures;if(J.length!==ht.length||J[0]!==i.COLOR_ATTACHMENT0){for(let dt=0,Dt=ht.length;dt<Dt;dt++)J[dt]=i.COLOR_ATTACHMENT0+dt;J.length=ht.length,mt=!0}}else J[0]!==i.BACK&&(J[0]=i.BACK,mt=!0);mt&&i.drawBuffers(J)}function ee(I){return _!==I?(i.useProgram(I),_=I,!0):!1}let _e={[Ws]:i.FUNC_ADD,[a0]:i.FUNC_SUBTRACT,[o0]:i.FUNC_REVERSE_SUBTRACT};_e[l0]=i.MIN,_e[c0]=i.MAX;let Qt={[h0]:i.ZERO,[u0]:i.ONE,[f0]:i.SRC_COLOR,[Uf]:i.SRC_ALPHA,[y0]:i.SRC_ALPHA_SATURATE,[g0]:i.DST_COLOR,[p0]:i.DST_ALPHA,[d0]:i.ONE_MINUS_SRC_COLOR,[Ff]:i.ONE_MINUS_SRC_ALPHA,[_0]:i.ONE_MINUS_DST_COLOR,[m0]:i.ONE_MINUS_DST_ALPHA,[x0]:i.CONSTANT_COLOR,[v0]:i.ONE_MINUS_CONSTANT_COLOR,[M0]:i.CONSTANT_ALPHA,[b0]:i.ONE_MINUS_CONSTANT_ALPHA};function Ge(I,nt,J,mt,ht,dt,Dt,Kt,ct,Ot){if(I===Hs){p===!0&&(At(i.BLEND),p=!1);return}if(p===!1&&(lt(i.BLEND),p=!0),I!==r0){if(I!==g||Ot!==L){if((y!==Ws||E!==Ws)&&(i.blendEquation(i.FUNC_ADD),y=Ws,E=Ws),Ot)switch(I){case qr:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Nf:i.blendFunc(i.ONE,i.ONE);break;case Df:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Of:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:Ht("WebGLState: Invalid blending: ",I);break}else switch(I){case qr:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Nf:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Df:Ht("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Of:Ht("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Ht("WebGLState: Invalid blending: ",I);break}w=null,b=null,T=null,x=null,A.set(0,0,0),F=0,g=I,L=Ot}return}ht=ht||nt,dt=dt||J,Dt=Dt||mt,(nt!==y||ht!==E)&&(i.blendEquationSeparate(_e[nt],_e[ht]),y=nt,E=ht),(J!==w||mt!==b||dt!==T||Dt!==x)&&(i.blendFuncSeparate(Qt[J],Qt[mt],Qt[dt],Qt[Dt]),w=J,b=mt,T=dt,x=Dt),(Kt.equals(A)===!1||ct!==F)&&(i.blendColor(Kt.r,Kt.g,Kt.b,ct),A.copy(Kt),F=ct),g=I,L=!1}function Ue(I,nt){I.side===Ei?At(i.CULL_FACE):lt(i.CULL_FACE);let J=I.side===In;nt&&(J=!J),fn(J),I.blending===qr&&I.transparent===!1?Ge(Hs):Ge(I.blending,I.blendEquation,I.blendSrc,I.blendDst,I.blendEquationAlpha,I.blendSrcAlpha,I.blendDstAlpha,I.blendColor,I.blendAlpha,I.premultipliedAlpha),a.setFunc(I.depthFunc),a.setTest(I.depthTest),a.setMask(I.depthWrite),r.setMask(I.colorWrite);let mt=I.stencilWrite;o.setTest(mt),mt&&(o.setMask(I.stencilWriteMask),o.setFunc(I.stencilFunc,I.stencilRef,I.stencilFuncMask),o.setOp(I.stencilFail,I.stencilZFail,I.stencilZPass)),Be(I.polygonOffset,I.polygonOffsetFactor,I.polygonOffsetUnits),I.alphaToCoverage===!0?lt(i.SAMPLE_ALPHA_TO_COVERAGE):At(i.SAMPLE_ALPHA_TO_COVERAGE)}function fn(I){O!==I&&(I?i.frontFace(i.CW):i.frontFace(i.CCW),O=I)}function ye(I){I!==n0?(lt(i.CULL_FACE),I!==H&&(I===Lf?i.cullFace(i.BACK):I===i0?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):At(i.CULL_FACE),H=I}function oe(I){I!==Z&&($&&i.lineWidth(I),Z=I)}function Be(I,nt,J){I?(lt(i.POLYGON_OFFSET_FILL),(P!==nt||W!==J)&&(P=nt,W=J,a.getReversed()&&(nt=-nt,J=-J),i.polygonOffset(nt,J))):At(i.POLYGON_OFFSET_FILL)}function Mn(I){I?lt(i.SCISSOR_TEST):At(i.SCISSOR_TEST)}function pn(I){I===void 0&&(I=i.TEXTURE0+tt-1),k!==I&&(i.activeTexture(I),k=I)}function ze(I,nt,J){J===void 0&&(k===null?J=i.TEXTURE0+tt-1:J=k);let mt=it[J];mt===void 0&&(mt={type:void 0,texture:void 0},it[J]=mt),(mt.type!==I||mt.texture!==nt)&&(k!==J&&(i.activeTexture(J),k=J),i.bindTexture(I,nt||Nt[I]),mt.type=I,mt.texture=nt)}function D(){let I=it[k];I!==void 0&&I.type!==void 0&&(i.bindTexture(I.type,null),I.type=void 0,I.texture=void 0)}function bn(){try{i.compressedTexImage2D(...arguments)}catch(I){Ht("WebGLState:",I)}}function pe(){try{i.compressedTexImage3D(...arguments)}catch(I){Ht("WebGLState:",I)}}function Ae(){try{i.texSubImage2D(...arguments)}catch(I){Ht("WebGLState:",I)}}function Mt(){try{i.texSubImage3D(...arguments)}catch(I){Ht("WebGLState:",I)}}function ke(){try{i.compressedTexSubImage2D(...arguments)}catch(I){Ht("WebGLState:",I)}}function Bt(){try{i.compressedTexSubImage3D(...arguments)}catch(I){Ht("WebGLState:",I)}}function Gt(){try{i.texStorage2D(...arguments)}catch(I){Ht("WebGLState:",I)}}function C(){try{i.texStorage3D(...arguments)}catch(I){Ht("WebGLState:",I)}}function M(){try{i.texImage2D(...arguments)}catch(I){Ht("WebGLState:",I)}}function G(){try{i.texImage3D(...arguments)}catch(I){Ht("WebGLState:",I)}}function ot(I){return u[I]!==void 0?u[I]:i.getParameter(I)}function st(I,nt){u[I]!==nt&&(i.pixelStorei(I,nt),u[I]=nt)}function ut(I){et.equals(I)===!1&&(i.scissor(I.x,I.y,I.z,I.w),et.copy(I))}function yt(I){pt.equals(I)===!1&&(i.viewport(I.x,I.y,I.z,I.w),pt.copy(I))}function j(I,nt){let J=c.get(nt);J===void 0&&(J=new WeakMap,c.set(nt,J));let mt=J.get(I);mt===void 0&&(mt=i.getUniformBlockIndex(nt,I.name),i.uniformBlockBinding(nt,mt,mt),J.set(I,mt))}function Q(I,nt,J){let ht=c.get(nt).get(I);l[ht]!==J&&(i.bindBufferBase(i.UNIFORM_BUFFER,ht,J),l[ht]=J)}function ft(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),a.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},k=null,it={},f={},l={},d=new WeakMap,m=[],_=null,p=!1,g=null,y=null,w=null,b=null,E=null,T=null,x=null,A=new Jt(0,0,0),F=0,L=!1,O=null,H=null,Z=null,P=null,W=null,et.set(0,0,i.canvas.width,i.canvas.height),pt.set(0,0,i.canvas.width,i.canvas.height),r.reset(),a.reset(),o.reset()}return{buffers:{color:r,depth:a,stencil:o},enable:lt,disable:At,bindFramebuffer:ae,drawBuffers:Ft,useProgram:ee,setBlending:Ge,setMaterial:Ue,setFlipSided:fn,setCullFace:ye,setLineWidth:oe,setPolygonOffset:Be,setScissorTest:Mn,activeTexture:pn,bindTexture:ze,unbindTexture:D,compressedTexImage2D:bn,compressedTexImage3D:pe,texImage2D:M,texImage3D:G,pixelStorei:st,getParameter:ot,updateUBOMapping:j,uniformBlockBinding:Q,texStorage2D:Gt,texStorage3D:C,texSubImage2D:Ae,texSubImage3D:Mt,compressedTexSubImage2D:ke,compressedTexSubImage3D:Bt,scissor:ut,viewport:yt,reset:ft}}function KE(i,t,e,n,s,r,a){let o=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new zt,h=new WeakMap,u=new Set,f,d=new WeakMap,m=new Set,_=new FinalizationRegistry(C=>m.delete(C)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(C,M){return p?new OffscreenCanvas(C,M):za("canvas")}function y(C,M,G){let ot=1,st=Gt(C);if((st.width>G||st.height>G)&&(ot=G/Math.max(st.width,st.height)),ot<1)if(typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&C instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&C instanceof ImageBitmap||typeof VideoFrame<"u"&&C instanceof VideoFrame){let ut=Math.floor(ot*st.width),yt=Math.floor(ot*st.height);f===void 0&&(f=g(ut,yt));let j=M?g(ut,yt):f;return j.width=ut,j.height=yt,j.getContext("2d").drawImage(C,0,0,ut,yt),Ut("WebGLRenderer: Texture has been resized from ("+st.width+"x"+st.height+") to ("+ut+"x"+yt+")."),j}else return"data"in C&&Ut("WebGLRenderer: Image in DataTexture is too big ("+st.width+"x"+st.height+")."),C;return C}function w(C){return C.generateMipmaps}function b(C){i.generateMipmap(C)}function E(C){return C.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:C.isWebGL3DRenderTarget?i.TEXTURE_3D:C.isWebGLArrayRenderTarget||C.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function T(C,M,G,ot,st,ut=!1){if(C!==null){if(i[C]!==void 0)return i[C];Ut("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+C+"'")}let yt;ot&&(yt=t.get("EXT_texture_norm16"),yt||Ut("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let j=M;if(M===i.RED&&(G===i.FLOAT&&(j=i.R32F),G===i.HALF_FLOAT&&(j=i.R16F),G===i.UNSIGNED_BYTE&&(j=i.R8),G===i.UNSIGNED_SHORT&&yt&&(j=yt.R16_EXT),G===i.SHORT&&yt&&(j=yt.R16_SNORM_EXT)),M===i.RED_INTEGER&&(G===i.UNSIGNED_BYTE&&(j=i.R8UI),G===i.UNSIGNED_SHORT&&(j=i.R16UI),G===i.UNSIGNED_INT&&(j=i.R32UI),G===i.BYTE&&(j=i.R8I),G===i.SHORT&&(j=i.R16I),G===i.INT&&(j=i.R32I)),M===i.RG&&(G===i.FLOAT&&(j=i.RG32F),G===i.HALF_FLOAT&&(j=i.RG16F),G===i.UNSIGNED_BYTE&&(j=i.RG8),G===i.UNSIGNED_SHORT&&yt&&(j=yt.RG16_EXT),G===i.SHORT&&yt&&(j=yt.RG16_SNORM_EXT)),M===i.RG_INTEGER&&(G===i.UNSIGNED_BYTE&&(j=i.RG8UI),G===i.UNSIGNED_SHORT&&(j=i.RG16UI),G===i.UNSIGNED_INT&&(j=i.RG32UI),G===i.BYTE&&(j=i.RG8I),G===i.SHORT&&(j=i.RG16I),G===i.INT&&(j=i.RG32I)),M===i.RGB_INTEGER&&(G===i.UNSIGNED_BYTE&&(j=i.RGB8UI),G===i.UNSIGNED_SHORT&&(j=i.RGB16UI),G===i.UNSIGNED_INT&&(j=i.RGB32UI),G===i.BYTE&&(j=i.RGB8I),G===i.SHORT&&(j=i.RGB16I),G===i.INT&&(j=i.RGB32I)),M===i.RGBA_INTEGER&&(G===i.UNSIGNED_BYTE&&(j=i.RGBA8UI),G===i.UNSIGNED_SHORT&&(j=i.RGBA16UI),G===i.UNSIGNED_INT&&(j=i.RGBA32UI),G===i.BYTE&&(j=i.RGBA8I),G===i.SHORT&&(j=i.RGBA16I),G===i.INT&&(j=i.RGBA32I)),M===i.RGB&&(G===i.UNSIGNED_SHORT&&yt&&(j=yt.RGB16_EXT),G===i.SHORT&&yt&&(j=yt.RGB16_SNORM_EXT),G===i.UNSIGNED_INT_5_9_9_9_REV&&(j=i.RGB9_E5),G===i.UNSIGNED_INT_10F_11F_11F_REV&&(j=i.R11F_G11F_B10F)),M===i.RGBA){let Q=ut?ka:ce.getTransfer(st);G===i.FLOAT&&(j=i.RGBA32F),G===i.HALF_FLOAT&&(j=i.RGBA16F),G===i.UNSIGNED_BYTE&&(j=Q===ve?i.SRGB8_ALPHA8:i.RGBA8),G===i.UNSIGNED_SHORT&&yt&&(j=yt.RGBA16_EXT),G===i.SHORT&&yt&&(j=yt.RGBA16_SNORM_EXT),G===i.UNSIGNED_SHORT_4_4_4_4&&(j=i.RGBA4),G===i.UNSIGNED_SHORT_5_5_5_1&&(j=i.RGB5_A1)}return(j===i.R16F||j===i.R32F||j===i.RG16F||j===i.RG32F||j===i.RGBA16F||j===i.RGBA32F)&&t.get("EXT_color_buffer_float"),j}function x(C,M){let G;return C?M===null||M===pi||M===$s?G=i.DEPTH24_STENCIL8:M===si?G=i.DEPTH32F_STENCIL8:M===Zr&&(G=i.DEPTH24_STENCIL8,Ut("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):M===null||M===pi||M===$s?G=i.DEPTH_COMPONENT24:M===si?G=i.DEPTH_COMPONENT32F:M===Zr&&(G=i.DEPTH_COMPONENT16),G}function A(C,M){return w(C)===!0||C.isFramebufferTexture&&C.minFilter!==hn&&C.minFilter!==Cn?Math.log2(Math.max(M.width,M.height))+1:C.mipmaps.length>0?C.mipmaps.length:C.isCompressedTexture&&Array.isArray(C.image)?M.mipmaps.length:1}function F(C){let M=new WeakRef(C);n.get(C).__ref=M,m.add(M),_.register(C,M,M)}function L(C){let M=n.get(C).__ref;M!==void 0&&(m.delete(M),_.unregister(M))}function O(C){Z(C.target)}function H(C){P(C.target)}function Z(C){C.removeEventListener("dispose",O),L(C),tt(C),C.isVideoTexture&&h.delete(C),C.isHTMLTexture&&u.delete(C)}function P(C){C.removeEventListener("dispose",H),L(C),at(C)}function W(){for(let C of m){let M=C.deref();M!==void 0&&(M.isRenderTarget===!0?P(M):Z(M))}m.clear(),u.clear()}function tt(C){let M=n.get(C);if(M.__webglInit===void 0)return;let G=C.source,ot=d.get(G);if(ot){let st=ot[M.__cacheKey];st.usedTimes--,st.usedTimes===0&&$(C),Object.keys(ot).length===0&&d.delete(G)}n.remove(C)}function $(C){let M=n.get(C);i.deleteTexture(M.__webglTexture);let G=C.source,ot=d.get(G);delete ot[M.__cacheKey],a.memory.textures--}function at(C){let M=n.get(C);M.__depthDisposeCallback&&M.__depthDisposeCallback();let G=C.depthTexture;if(G&&G.renderTarget===C&&Z(G),C.isWebGLCubeRenderTarget)for(let st=0;st<6;st++){if(Array.isArray(M.__webglFramebuffer[st]))for(let ut=0;ut<M.__webglFramebuffer[st].length;ut++)i.deleteFramebuffer(M.__webglFramebuffer[st][ut]);else i.deleteFramebuffer(M.__webglFramebuffer[st]);M.__webglDepthbuffer&&i.deleteRenderbuffer(M.__webglDepthbuffer[st])}else{if(Array.isArray(M.__webglFramebuffer))for(let st=0;st<M.__webglFramebuffer.length;st++)i.deleteFramebuffer(M.__webglFramebuffer[st]);else i.deleteFramebuffer(M.__webglFramebuffer);if(M.__webglDepthbuffer&&i.deleteRenderbuffer(M.__webglDepthbuffer),M.__webglMultisampledFramebuffer&&i.deleteFramebuffer(M.__webglMultisampledFramebuffer),M.__webglColorRenderbuffer)for(let st=0;st<M.__webglColorRenderbuffer.length;st++)M.__webglColorRenderbuffer[st]&&i.deleteRenderbuffer(M.__webglColorRenderbuffer[st]);M.__webglDepthRenderbuffer&&i.deleteRenderbuffer(M.__webglDepthRenderbuffer)}let ot=C.textures;for(let st=0,ut=ot.length;st<ut;st++){let yt=n.get(ot[st]);yt.__webglTexture&&(i.deleteTexture(yt.__webglTexture),a.memory.textures--),n.remove(ot[st])}n.remove(C)}let X=0;function k(){X=0}function it(){return X}function Tt(C){X=C}function kt(){let C=X;return C>=s.maxTextures&&Ut("WebGLTextures: Trying to use "+(C+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,C}function et(C){let M=[];return M.push(C.wrapS),M.push(C.wrapT),M.push(C.wrapR||0),M.push(C.magFilter),M.push(C.minFilter),M.push(C.anisotropy),M.push(C.internalFormat),M.push(C.format),M.push(C.type),M.push(C.generateMipmaps),M.push(C.mipmapsAutoUpdate),M.push(C.premultiplyAlpha),M.push(C.flipY),M.push(C.unpackAlignment),M.push(C.colorSpace),M.join()}function pt(C,M){let G=n.get(C);if(C.isVideoTexture&&ke(C),C.isRenderTargetTexture===!1&&C.isExternalTexture!==!0&&C.version>0&&G.__version!==C.version){let ot=C.image;if(ot===null)Ut("WebGLRenderer: Texture marked for update but no image data found.");else if(ot.complete===!1)Ut("WebGLRenderer: Texture marked for update but image is incomplete");else{Ue(G,C,M);return}}else C.isExternalTexture&&(G.__webglTexture=C.sourceTexture?C.sourceTexture:null);e.bindTexture(i.TEXTURE_2D,G.__webglTexture,i.TEXTURE0+M)}function _t(C,M){let G=n.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&G.__version!==C.version){Ue(G,C,M);return}else C.isExternalTexture&&(G.__webglTexture=C.sourceTexture?C.sourceTexture:null);e.bindTexture(i.TEXTURE_2D_ARRAY,G.__webglTexture,i.TEXTURE0+M)}function Nt(C,M){let G=n.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&G.__version!==C.version){Ue(G,C,M);return}e.bindTexture(i.TEXTURE_3D,G.__webglTexture,i.TEXTURE0+M)}function lt(C,M){let G=n.get(C);if(C.version>0&&G.__version!==C.version){fn(G,C,M);return}e.bindTexture(i.TEXTURE_CUBE_MAP,G.__webglTexture,i.TEXTURE0+M)}let At={[Kl]:i.REPEAT,[bi]:i.CLAMP_TO_EDGE,[jl]:i.MIRRORED_REPEAT},ae={[hn]:i.NEAREST,[A0]:i.NEAREST_MIPMAP_NEAREST,[ho]:i.NEAREST_MIPMAP_LINEAR,[Cn]:i.LINEAR,[Sc]:i.LINEAR_MIPMAP_NEAREST,[qi]:i.LINEAR_MIPMAP_LINEAR},Ft={[P0]:i.NEVER,[ed]:i.ALWAYS,[I0]:i.LESS,[Qf]:i.LEQUAL,[L0]:i.EQUAL,[td]:i.GEQUAL,[N0]:i.GREATER,[D0]:i.NOTEQUAL};function ee(C,M){if(M.type===si&&t.has("OES_texture_float_linear")===!1&&(M.magFilter===Cn||M.magFilter===Sc||M.magFilter===ho||M.magFilter===qi||M.minFilter===Cn||M.minFilter===Sc||M.minFilter===ho||M.minFilter===qi)&&Ut("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(C,i.TEXTURE_WRAP_S,At[M.wrapS]),i.texParameteri(C,i.TEXTURE_WRAP_T,At[M.wrapT]),(C===i.TEXTURE_3D||C===i.TEXTURE_2D_ARRAY)&&i.texParameteri(C,i.TEXTURE_WRAP_R,At[M.wrapR]),i.texParameteri(C,i.TEXTURE_MAG_FILTER,ae[M.magFilter]),i.texParameteri(C,i.TEXTURE_MIN_FILTER,ae[M.minFilter]),M.compareFunction&&(i.texParameteri(C,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(C,i.TEXTURE_COMPARE_FUNC,Ft[M.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(M.magFilter===hn||M.minFilter!==ho&&M.minFilter!==qi||M.type===si&&t.has("OES_texture_float_linear")===!1)return;if(M.anisotropy>1||n.get(M).__currentAnisotropy){let G=t.get("EXT_texture_filter_anisotropic");i.texParameterf(C,G.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(M.anisotropy,s.getMaxAnisotropy())),n.get(M).__currentAnisotropy=M.anisotropy}}}function _e(C,M){let G=!1;C.__webglInit===void 0&&(C.__webglInit=!0,M.addEventListener("dispose",O),F(M));let ot=M.source,st=d.get(ot);st===void 0&&(st={},d.set(ot,st));let ut=et(M);if(ut!==C.__cacheKey){st[ut]===void 0&&(st[ut]={texture:i.createTexture(),usedTimes:0},a.memory.textures++,G=!0),st[ut].usedTimes++;let yt=st[C.__cacheKey];yt!==void 0&&(st[C.__cacheKey].usedTimes--,yt.usedTimes===0&&$(M)),C.__cacheKey=ut,C.__webglTexture=st[ut].texture}return G}function Qt(C,M,G){return Math.floor(Math.floor(C/G)/M)}function Ge(C,M,G,ot){let ut=C.updateRanges;if(ut.length===0)e.texSubImage2D(i.TEXTURE_2D,0,0,0,M.width,M.height,G,ot,M.data);else{ut.sort((I,nt)=>I.start-nt.start);let yt=0;for(let I=1;I<ut.length;I++){let nt=ut[yt],J=ut[I],mt=nt.start+nt.count,ht=Qt(J.start,M.width,4),dt=Qt(nt.start,M.width,4);J.start<=mt+1&&ht===dt&&Qt(J.start+J.count-1,M.width,4)===ht?nt.count=Math.max(nt.count,J.start+J.count-nt.start):(++yt,ut[yt]=J)}ut.length=yt+1;let j=e.getParameter(i.UNPACK_ROW_LENGTH),Q=e.getParameter(i.UNPACK_SKIP_PIXELS),ft=e.getParameter(i.UNPACK_SKIP_ROWS);e.pixelStorei(i.UNPACK_ROW_LENGTH,M.width);for(let I=0,nt=ut.length;I<nt;I++){let J=ut[I],mt=Math.floor(J.start/4),ht=Math.ceil(J.count/4),dt=mt%M.width,Dt=Math.floor(mt/M.width),Kt=ht,ct=1;e.pixelStorei(i.UNPACK_SKIP_PIXELS,dt),e.pixelStorei(i.UNPACK_SKIP_ROWS,Dt),e.texSubImage2D(i.TEXTURE_2D,0,dt,Dt,Kt,ct,G,ot,M.data)}C.clearUpdateRanges(),e.pixelStorei(i.UNPACK_ROW_LENGTH,j),e.pixelStorei(i.UNPACK_SKIP_PIXELS,Q),e.pixelStorei(i.UNPACK_SKIP_ROWS,ft)}}function Ue(C,M,G){let ot=i.TEXTURE_2D;(M.isDataArrayTexture||M.isCompressedArrayTexture)&&(ot=i.TEXTURE_2D_ARRAY),M.isData3DTexture&&(ot=i.TEXTURE_3D);let st=_e(C,M),ut=M.source;e.bindTexture(ot,C.__webglTexture,i.TEXTURE0+G);let yt=n.get(ut);if(ut.version!==yt.__version||st===!0){if(e.activeTexture(i.TEXTURE0+G),(typeof ImageBitmap<"u"&&M.image instanceof ImageBitmap)===!1){let ct=ce.getPrimaries(ce.workingColorSpace),Ot=M.colorSpace===Zi?null:ce.getPrimaries(M.colorSpace),Zt=M.colorSpace===Zi||ct===Ot?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,M.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Zt)}e.pixelStorei(i.UNPACK_ALIGNMENT,M.unpackAlignment);let Q=y(M.image,!1,s.maxTextureSize);Q=Bt(M,Q);let ft=r.convert(M.format,M.colorSpace),I=r.convert(M.type),nt=T(M.internalFormat,ft,I,M.normalized,M.colorSpace,M.isVideoTexture);ee(ot,M);let J,mt=M.mipmaps,ht=M.isVideoTexture!==!0,dt=yt.__version===void 0||st===!0,Dt=ut.dataReady,Kt=A(M,Q);if(M.isDepthTexture)nt=x(M.format===Yi,M.type),dt&&(ht?e.texStorage2D(i.TEXTURE_2D,1,nt,Q.width,Q.height):e.texImage2D(i.TEXTURE_2D,0,nt,Q.width,Q.height,0,ft,I,null));else if(M.isDataTexture)if(mt.length>0){ht&&dt&&e.texStorage2D(i.TEXTURE_2D,Kt,nt,mt[0].width,mt[0].height);for(let ct=0,Ot=mt.length;ct<Ot;ct++)J=mt[ct],ht?Dt&&e.texSubImage2D(i.TEXTURE_2D,ct,0,0,J.width,J.height,ft,I,J.data):e.texImage2D(i.TEXTURE_2D,ct,nt,J.width,J.height,0,ft,I,J.data);M.generateMipmaps=!1}else ht?(dt&&e.texStorage2D(i.TEXTURE_2D,Kt,nt,Q.width,Q.height),Dt&&Ge(M,Q,ft,I)):e.texImage2D(i.TEXTURE_2D,0,nt,Q.width,Q.height,0,ft,I,Q.data);else if(M.isCompressedTexture)if(M.isCompressedArrayTexture){ht&&dt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Kt,nt,mt[0].width,mt[0].height,Q.depth);for(let ct=0,Ot=mt.length;ct<Ot;ct++)if(J=mt[ct],M.format!==ri)if(ft!==null)if(ht){if(Dt)if(M.layerUpdates.size>0){let Zt=ud(J.width,J.height,M.format,M.type);for(let bt of M.layerUpdates){let me=J.data.subarray(bt*Zt/J.data.BYTES_PER_ELEMENT,(bt+1)*Zt/J.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ct,0,0,bt,J.width,J.height,1,ft,me)}}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ct,0,0,0,J.width,J.height,Q.depth,ft,J.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,ct,nt,J.width,J.height,Q.depth,0,J.data,0,0);else Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ht?Dt&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,ct,0,0,0,J.width,J.height,Q.depth,ft,I,J.data):e.texImage3D(i.TEXTURE_2D_ARRAY,ct,nt,J.width,J.height,Q.depth,0,ft,I,J.data);M.layerUpdates.size>0&&M.clearLayerUpdates()}else{ht&&dt&&e.texStorage2D(i.TEXTURE_2D,Kt,nt,mt[0].width,mt[0].height);for(let ct=0,Ot=mt.length;ct<Ot;ct++)J=mt[ct],M.format!==ri?ft!==null?ht?Dt&&e.compressedTexSubImage2D(i.TEXTURE_2D,ct,0,0,J.width,J.height,ft,J.data):e.compressedTexImage2D(i.TEXTURE_2D,ct,nt,J.width,J.height,0,J.data):Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ht?Dt&&e.texSubImage2D(i.TEXTURE_2D,ct,0,0,J.width,J.height,ft,I,J.data):e.texImage2D(i.TEXTURE_2D,ct,nt,J.width,J.height,0,ft,I,J.data)}else if(M.isDataArrayTexture)if(ht){if(dt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Kt,nt,Q.width,Q.height,Q.depth),Dt)if(M.layerUpdates.size>0){let ct=ud(Q.width,Q.height,M.format,M.type);for(let Ot of M.layerUpdates){let Zt=Q.data.subarray(Ot*ct/Q.data.BYTES_PER_ELEMENT,(Ot+1)*ct/Q.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Ot,Q.width,Q.height,1,ft,I,Zt)}M.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,Q.width,Q.height,Q.depth,ft,I,Q.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,nt,Q.width,Q.height,Q.depth,0,ft,I,Q.data);else if(M.isData3DTexture)ht?(dt&&e.texStorage3D(i.TEXTURE_3D,Kt,nt,Q.width,Q.height,Q.depth),Dt&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,Q.width,Q.height,Q.depth,ft,I,Q.data)):e.texImage3D(i.TEXTURE_3D,0,nt,Q.width,Q.height,Q.depth,0,ft,I,Q.data);else if(M.isFramebufferTexture){if(dt)if(ht)e.texStorage2D(i.TEXTURE_2D,Kt,nt,Q.width,Q.height);else{let ct=Q.width,Ot=Q.height;for(let Zt=0;Zt<Kt;Zt++)e.texImage2D(i.TEXTURE_2D,Zt,nt,ct,Ot,0,ft,I,null),ct>>=1,Ot>>=1}}else if(M.isHTMLTexture){if("texElementImage2D"in i){let ct=i.canvas;if(ct.hasAttribute("layoutsubtree")||ct.setAttribute("layoutsubtree","true"),Q.parentNode!==ct){ct.appendChild(Q),u.add(M),ct.onpaint=Ot=>{let Zt=Ot.changedElements;for(let bt of u)Zt.includes(bt.image)&&(bt.needsUpdate=!0)},ct.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,Q);else{let Zt=i.RGBA,bt=i.RGBA,me=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,Zt,bt,me,Q)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(mt.length>0){if(ht&&dt){let ct=Gt(mt[0]);e.texStorage2D(i.TEXTURE_2D,Kt,nt,ct.width,ct.height)}for(let ct=0,Ot=mt.length;ct<Ot;ct++)J=mt[ct],ht?Dt&&e.texSubImage2D(i.TEXTURE_2D,ct,0,0,ft,I,J):e.texImage2D(i.TEXTURE_2D,ct,nt,ft,I,J);M.generateMipmaps=!1}else if(ht){if(dt){let ct=Gt(Q);e.texStorage2D(i.TEXTURE_2D,Kt,nt,ct.width,ct.height)}Dt&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,ft,I,Q)}else e.texImage2D(i.TEXTURE_2D,0,nt,ft,I,Q);w(M)&&M.mipmapsAutoUpdate===!0&&b(ot),yt.__version=ut.version,M.onUpdate&&M.onUpdate(M)}C.__version=M.version}function fn(C,M,G){if(M.image.length!==6)return;let ot=_e(C,M),st=M.source;e.bindTexture(i.TEXTURE_CUBE_MAP,C.__webglTexture,i.TEXTURE0+G);let ut=n.get(st);if(st.version!==ut.__version||ot===!0){e.activeTexture(i.TEXTURE0+G);let yt=ce.getPrimaries(ce.workingColorSpace),j=M.colorSpace===Zi?null:ce.getPrimaries(M.colorSpace),Q=M.colorSpace===Zi||yt===j?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,M.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),e.pixelStorei(i.UNPACK_ALIGNMENT,M.unpackAlignment),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Q);let ft=M.isCompressedTexture||M.image[0].isCompressedTexture,I=M.image[0]&&M.image[0].isDataTexture,nt=[];for(let bt=0;bt<6;bt++)!ft&&!I?nt[bt]=y(M.image[bt],!0,s.maxCubemapSize):nt[bt]=I?M.image[bt].image:M.image[bt],nt[bt]=Bt(M,nt[bt]);let J=nt[0],mt=r.convert(M.format,M.colorSpace),ht=r.convert(M.type),dt=T(M.internalFormat,mt,ht,M.normalized,M.colorSpace),Dt=M.isVideoTexture!==!0,Kt=ut.__version===void 0||ot===!0,ct=st.dataReady,Ot=A(M,J);ee(i.TEXTURE_CUBE_MAP,M);let Zt;if(M.isDepthTexture){if(dt=x(M.format===Yi,M.type),Kt)if(Dt)e.texStorage2D(i.TEXTURE_CUBE_MAP,1,dt,J.width,J.height);else for(let bt=0;bt<6;bt++)e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,0,dt,J.width,J.height,0,mt,ht,null)}else if(ft){Dt&&Kt&&e.texStorage2D(i.TEXTURE_CUBE_MAP,Ot,dt,J.width,J.height);for(let bt=0;bt<6;bt++){Zt=nt[bt].mipmaps;for(let me=0;me<Zt.length;me++){let Ve=Zt[me];M.format!==ri?mt!==null?Dt?ct&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me,0,0,Ve.width,Ve.height,mt,Ve.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me,dt,Ve.width,Ve.height,0,Ve.data):Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me,0,0,Ve.width,Ve.height,mt,ht,Ve.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me,dt,Ve.width,Ve.height,0,mt,ht,Ve.data)}}}else{if(Zt=M.mipmaps,Dt&&Kt){Zt.length>0&&Ot++;let bt=Gt(nt[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,Ot,dt,bt.width,bt.height)}for(let bt=0;bt<6;bt++)if(I){Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,0,0,0,nt[bt].width,nt[bt].height,mt,ht,nt[bt].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,0,dt,nt[bt].width,nt[bt].height,0,mt,ht,nt[bt].data);for(let me=0;me<Zt.length;me++){let gi=Zt[me].image[bt].image;Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me+1,0,0,gi.width,gi.height,mt,ht,gi.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me+1,dt,gi.width,gi.height,0,mt,ht,gi.data)}}else{Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,0,0,0,mt,ht,nt[bt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,0,dt,mt,ht,nt[bt]);for(let me=0;me<Zt.length;me++){let Ve=Zt[me];Dt?ct&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me+1,0,0,mt,ht,Ve.image[bt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,me+1,dt,mt,ht,Ve.image[bt])}}}w(M)&&M.mipmapsAutoUpdate===!0&&b(i.TEXTURE_CUBE_MAP),ut.__version=st.version,M.onUpdate&&M.onUpdate(M)}C.__version=M.version}function ye(C,M,G,ot,st,ut){let yt=r.convert(G.format,G.colorSpace),j=r.convert(G.type),Q=T(G.internalFormat,yt,j,G.normalized,G.colorSpace),ft=n.get(M),I=n.get(G);if(I.__renderTarget=M,!ft.__hasExternalTextures){let nt=Math.max(1,M.width>>ut),J=Math.max(1,M.height>>ut);st===i.TEXTURE_3D||st===i.TEXTURE_2D_ARRAY?e.texImage3D(st,ut,Q,nt,J,M.depth,0,yt,j,null):e.texImage2D(st,ut,Q,nt,J,0,yt,j,null)}e.bindFramebuffer(i.FRAMEBUFFER,C),Mt(M)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ot,st,I.__webglTexture,0,Ae(M)):(st===i.TEXTURE_2D||st>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&st<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,ot,st,I.__webglTexture,ut),e.bindFramebuffer(i.FRAMEBUFFER,null)}function oe(C,M,G){if(i.bindRenderbuffer(i.RENDERBUFFER,C),M.depthBuffer){let ot=M.depthTexture,st=ot&&ot.isDepthTexture?ot.type:null,ut=x(M.stencilBuffer,st),yt=M.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;Mt(M)?o.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Ae(M),ut,M.width,M.height):G?i.renderbufferStorageMultisample(i.RENDERBUFFER,Ae(M),ut,M.width,M.height):i.renderbufferStorage(i.RENDERBUFFER,ut,M.width,M.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,yt,i.RENDERBUFFER,C)}else{let ot=M.textures;for(let st=0;st<ot.length;st++){let ut=ot[st],yt=r.convert(ut.format,ut.colorSpace),j=r.convert(ut.type),Q=T(ut.internalFormat,yt,j,ut.normalized,ut.colorSpace);Mt(M)?o.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Ae(M),Q,M.width,M.height):G?i.renderbufferStorageMultisample(i.RENDERBUFFER,Ae(M),Q,M.width,M.height):i.renderbufferStorage(i.RENDERBUFFER,Q,M.width,M.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Be(C,M,G){let ot=M.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(i.FRAMEBUFFER,C),!(M.depthTexture&&M.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let st=n.get(M.depthTexture);st.__renderTarget=M;let ut=ot?M.depthTexture.image[0]:M.depthTexture.image;(!st.__webglTexture||ut.width!==M.width||ut.height!==M.height)&&(ut.width=M.width,ut.height=M.height,M.depthTexture.needsUpdate=!0),ot?lt(M.depthTexture,0):pt(M.depthTexture,0);let yt=st.__webglTexture,j=Ae(M),Q=ot?i.TEXTURE_CUBE_MAP_POSITIVE_X+G:i.TEXTURE_2D,ft=M.depthTexture.format===Yi?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(M.depthTexture.format===Gi)Mt(M)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ft,Q,yt,0,j):i.framebufferTexture2D(i.FRAMEBUFFER,ft,Q,yt,0);else if(M.depthTexture.format===Yi)Mt(M)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ft,Q,yt,0,j):i.framebufferTexture2D(i.FRAMEBUFFER,ft,Q,yt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Mn(C){let M=n.get(C),G=C.isWebGLCubeRenderTarget===!0;if(M.__boundDepthTexture!==C.depthTexture){let ot=C.depthTexture;if(M.__depthDisposeCallback&&M.__depthDisposeCallback(),ot){let st=()=>{delete M.__boundDepthTexture,delete M.__depthDisposeCallback,ot.removeEventListener("dispose",st)};ot.addEventListener("dispose",st),M.__depthDisposeCallback=st}M.__boundDepthTexture=ot}if(C.depthTexture&&!M.__autoAllocateDepthBuffer)if(G)for(let ot=0;ot<6;ot++)Be(M.__webglFramebuffer[ot],C,ot);else C.texture.mipmaps.length>0?Be(M.__webglFramebuffer[0],C,0):Be(M.__webglFramebuffer,C,0);else if(G){M.__webglDepthbuffer=[];for(let ot=0;ot<6;ot++)if(e.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer[ot]),M.__webglDepthbuffer[ot]===void 0)M.__webglDepthbuffer[ot]=i.createRenderbuffer(),oe(M.__webglDepthbuffer[ot],C,!1);else{let st=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ut=M.__webglDepthbuffer[ot];i.bindRenderbuffer(i.RENDERBUFFER,ut),i.framebufferRenderbuffer(i.FRAMEBUFFER,st,i.RENDERBUFFER,ut)}}else if(C.texture.mipmaps.length>0?e.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer[0]):e.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer),M.__webglDepthbuffer===void 0)M.__webglDepthbuffer=i.createRenderbuffer(),oe(M.__webglDepthbuffer,C,!1);else{let st=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ut=M.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,ut),i.framebufferRenderbuffer(i.FRAMEBUFFER,st,i.RENDERBUFFER,ut)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function pn(C,M,G){let ot=n.get(C);M!==void 0&&ye(ot.__webglFramebuffer,C,C.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),G!==void 0&&Mn(C)}function ze(C){let M=C.texture,G=n.get(C),ot=n.get(M);C.addEventListener("dispose",H),F(C);let st=C.textures,ut=C.isWebGLCubeRenderTarget===!0,yt=st.length>1;if(yt||(ot.__webglTexture===void 0&&(ot.__webglTexture=i.createTexture()),ot.__version=M.version,a.memory.textures++),ut){G.__webglFramebuffer=[];for(let j=0;j<6;j++)if(M.mipmaps.length>0){G.__webglFramebuffer[j]=[];for(let Q=0;Q<M.mipmaps.length;Q++)G.__webglFramebuffer[j][Q]=i.createFramebuffer()}else G.__webglFramebuffer[j]=i.createFramebuffer()}else{if(M.mipmaps.length>0){G.__webglFramebuffer=[];for(let j=0;j<M.mipmaps.length;j++)G.__webglFramebuffer[j]=i.createFramebuffer()}else G.__webglFramebuffer=i.createFramebuffer();if(yt)for(let j=0,Q=st.length;j<Q;j++){let ft=n.get(st[j]);ft.__webglTexture===void 0&&(ft.__webglTexture=i.createTexture(),a.memory.textures++)}if(C.samples>0&&Mt(C)===!1){G.__webglMultisampledFramebuffer=i.createFramebuffer(),G.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,G.__webglMultisampledFramebuffer);for(let j=0;j<st.length;j++){let Q=st[j];G.__webglColorRenderbuffer[j]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,G.__webglColorRenderbuffer[j]);let ft=r.convert(Q.format,Q.colorSpace),I=r.convert(Q.type),nt=T(Q.internalFormat,ft,I,Q.normalized,Q.colorSpace,C.isXRRenderTarget===!0),J=Ae(C);i.renderbufferStorageMultisample(i.RENDERBUFFER,J,nt,C.width,C.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+j,i.RENDERBUFFER,G.__webglColorRenderbuffer[j])}i.bindRenderbuffer(i.RENDERBUFFER,null),C.depthBuffer&&(G.__webglDepthRenderbuffer=i.createRenderbuffer(),oe(G.__webglDepthRenderbuffer,C,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(ut){e.bindTexture(i.TEXTURE_CUBE_MAP,ot.__webglTexture),ee(i.TEXTURE_CUBE_MAP,M);for(let j=0;j<6;j++)if(M.mipmaps.length>0)for(let Q=0;Q<M.mipmaps.length;Q++)ye(G.__webglFramebuffer[j][Q],C,M,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+j,Q);else ye(G.__webglFramebuffer[j],C,M,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+j,0);w(M)?b(i.TEXTURE_CUBE_MAP):M.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),e.unbindTexture()}else if(yt){for(let j=0,Q=st.length;j<Q;j++){let ft=st[j],I=n.get(ft),nt=i.TEXTURE_2D;(C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(nt=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(nt,I.__webglTexture),ee(nt,ft),ye(G.__webglFramebuffer,C,ft,i.COLOR_ATTACHMENT0+j,nt,0),w(ft)&&b(nt)}e.unbindTexture()}else{let j=i.TEXTURE_2D;if((C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(j=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(j,ot.__webglTexture),ee(j,M),M.mipmaps.length>0)for(let Q=0;Q<M.mipmaps.length;Q++)ye(G.__webglFramebuffer[Q],C,M,i.COLOR_ATTACHMENT0,j,Q);else ye(G.__webglFramebuffer,C,M,i.COLOR_ATTACHMENT0,j,0);w(M)?b(j):M.mipmaps.length>0&&i.texParameteri(j,i.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),e.unbindTexture()}C.depthBuffer&&Mn(C)}function D(C){let M=C.textures;for(let G=0,ot=M.length;G<ot;G++){let st=M[G];if(w(st)&&st.mipmapsAutoUpdate===!0){let ut=E(C),yt=n.get(st).__webglTexture;e.bindTexture(ut,yt),b(ut),e.unbindTexture()}}}let bn=[];function pe(C){if(C.samples>0){if(Mt(C)===!1){let M=C.textures,G=C.width,ot=C.height,st=i.COLOR_BUFFER_BIT,ut=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,yt=n.get(C),j=M.length>1;if(j)for(let ft=0;ft<M.length;ft++)e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,yt.__webglMultisampledFramebuffer),C.texture.mipmaps.length>0?e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglFramebuffer[0]):e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglFramebuffer);for(let ft=0;ft<M.length;ft++){if(C.resolveDepthBuffer&&(C.depthBuffer&&(st|=i.DEPTH_BUFFER_BIT),C.stencilBuffer&&C.resolveStencilBuffer&&(st|=i.STENCIL_BUFFER_BIT)),j){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,yt.__webglColorRenderbuffer[ft]);let I=n.get(M[ft]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,I,0)}i.blitFramebuffer(0,0,G,ot,0,0,G,ot,st,i.NEAREST),l===!0&&(bn.length=0,bn.push(i.COLOR_ATTACHMENT0+ft),C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&bn.push(ut),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,bn))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),j)for(let ft=0;ft<M.length;ft++){e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.RENDERBUFFER,yt.__webglColorRenderbuffer[ft]);let I=n.get(M[ft]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ft,i.TEXTURE_2D,I,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglMultisampledFramebuffer)}else if(C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&l){let M=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[M])}}}function Ae(C){return Math.min(s.maxSamples,C.samples)}function Mt(C){let M=n.get(C);return C.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&M.__useRenderToTexture!==!1}function ke(C){let M=a.render.frame;h.get(C)!==M&&(h.set(C,M),C.update())}function Bt(C,M){let G=C.colorSpace,ot=C.format,st=C.type;return C.isCompressedTexture===!0||C.isVideoTexture===!0||G!==Ba&&G!==Zi&&(ce.getTransfer(G)===ve?(ot!==ri||st!==Un)&&Ut("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Ht("WebGLTextures: Unsupported texture color space:",G)),M}function Gt(C){return typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement?(c.width=C.naturalWidth||C.width,c.height=C.naturalHeight||C.height):typeof VideoFrame<"u"&&C instanceof VideoFrame?(c.width=C.displayWidth,c.height=C.displayHeight):(c.width=C.width,c.height=C.height),c}this.allocateTextureUnit=kt,this.resetTextureUnits=k,this.getTextureUnits=it,this.setTextureUnits=Tt,this.setTexture2D=pt,this.setTexture2DArray=_t,this.setTexture3D=Nt,this.setTextureCube=lt,this.rebindTextures=pn,this.setupRenderTarget=ze,this.updateRenderTargetMipmap=D,this.updateMultisampleRenderTarget=pe,this.setupDepthRenderbuffer=Mn,this.setupFrameBufferTexture=ye,this.useMultisampledRTT=Mt,this.dispose=W}function jE(i,t){function e(n,s=Zi){let r,a=ce.getTransfer(s);if(n===Un)return i.UNSIGNED_BYTE;if(n===Ac)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Tc)return i.UNSIGNED_SHORT_5_5_5_1;if(n===Yf)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Zf)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===$f)return i.BYTE;if(n===qf)return i.SHORT;if(n===Zr)return i.UNSIGNED_SHORT;if(n===Ec)return i.INT;if(n===pi)return i.UNSIGNED_INT;if(n===si)return i.FLOAT;if(n===mi)return i.HALF_FLOAT;if(n===Jf)return i.ALPHA;if(n===Kf)return i.RGB;if(n===ri)return i.RGBA;if(n===Gi)return i.DEPTH_COMPONENT;if(n===Yi)return i.DEPTH_STENCIL;if(n===jf)return i.RED;if(n===Rc)return i.RED_INTEGER;if(n===ys)return i.RG;if(n===Cc)return i.RG_INTEGER;if(n===Pc)return i.RGBA_INTEGER;if(n===uo||n===fo||n===po||n===mo)if(a===ve)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===uo)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===fo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===po)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===mo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===uo)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===fo)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===po)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===mo)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Ic||n===Lc||n===Nc||n===Dc)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Ic)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Lc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Nc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Dc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Oc||n===Uc||n===Fc||n===Bc||n===kc||n===go||n===zc)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Oc||n===Uc)return a===ve?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Fc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Bc)return r.COMPRESSED_R11_EAC;if(n===kc)return r.COMPRESSED_SIGNED_R11_EAC;if(n===go)return r.COMPRESSED_RG11_EAC;if(n===zc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Gc||n===Vc||n===Hc||n===Wc||n===Xc||n===$c||n===qc||n===Yc||n===Zc||n===Jc||n===Kc||n===jc||n===Qc||n===th)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Gc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Vc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Hc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Wc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Xc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===$c)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===qc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Yc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Zc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Jc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Kc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===jc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Qc)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===th)return a===ve?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===eh||n===nh||n===ih)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===eh)return a===ve?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===nh)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===ih)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===sh||n===rh||n===_o||n===ah)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===sh)return r.COMPRESSED_RED_RGTC1_EXT;if(n===rh)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===_o)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===ah)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===$s?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}var QE=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,tA=`
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

}`,vd=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let n=new ja(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=n}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new Si({vertexShader:QE,fragmentShader:tA,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new On(new Gs(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Md=class extends di{constructor(t,e){super();let n=this,s=null,r=1,a=null,o="local-floor",l=1,c=null,h=null,u=null,f=null,d=null,m=null,_=typeof XRWebGLBinding<"u",p=new vd,g={},y=e.getContextAttributes(),w=null,b=null,E=[],T=[],x=new zt,A=null,F=null,L=new Rn;L.viewport=new be;let O=new Rn;O.viewport=new be;let H=[L,O],Z=new vc,P=null,W=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(et){let pt=E[et];return pt===void 0&&(pt=new kr,E[et]=pt),pt.getTargetRaySpace()},this.getControllerGrip=function(et){let pt=E[et];return pt===void 0&&(pt=new kr,E[et]=pt),pt.getGripSpace()},this.getHand=function(et){let pt=E[et];return pt===void 0&&(pt=new kr,E[et]=pt),pt.getHandSpace()};function tt(et){let pt=T.indexOf(et.inputSource);if(pt===-1)return;let _t=E[pt];_t!==void 0&&(_t.update(et.inputSource,et.frame,c||a),_t.dispatchEvent({type:et.type,data:et.inputSource}))}function $(){s.removeEventListener("select",tt),s.removeEventListener("selectstart",tt),s.removeEventListener("selectend",tt),s.removeEventListener("squeeze",tt),s.removeEventListener("squeezestart",tt),s.removeEventListener("squeezeend",tt),s.removeEventListener("end",$),s.removeEventListener("inputsourceschange",at);for(let et=0;et<E.length;et++){let pt=T[et];pt!==null&&(T[et]=null,E[et].disconnect(pt))}P=null,W=null,p.reset();for(let et in g)delete g[et];if(t.setRenderTarget(w),d=null,f=null,u=null,s=null,b=null,kt.stop(),n.isPresenting=!1,t.setPixelRatio(A),t.setSize(x.width,x.height,!1),F!==null){let et=F.camera;et.fov=F.fov,et.zoom=F.zoom,et.updateProjectionMatrix(),F=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(et){r=et,n.isPresenting===!0&&Ut("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(et){o=et,n.isPresenting===!0&&Ut("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||a},this.setReferenceSpace=function(et){c=et},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return m},this.getSession=function(){return s},this.setSession=async function(et){if(s=et,s!==null){if(w=t.getRenderTarget(),s.addEventListener("select",tt),s.addEventListener("selectstart",tt),s.addEventListener("selectend",tt),s.addEventListener("squeeze",tt),s.addEventListener("squeezestart",tt),s.addEventListener("squeezeend",tt),s.addEventListener("end",$),s.addEventListener("inputsourceschange",at),y.xrCompatible!==!0&&await e.makeXRCompatible(),A=t.getPixelRatio(),t.getSize(x),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let _t=null,Nt=null,lt=null;y.depth&&(lt=y.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,_t=y.stencil?Yi:Gi,Nt=y.stencil?$s:pi);let At={colorFormat:e.RGBA8,depthFormat:lt,scaleFactor:r};u=this.getBinding(),f=u.createProjectionLayer(At),s.updateRenderState({layers:[f]}),t.setPixelRatio(1),t.setSize(f.textureWidth,f.textureHeight,!1),b=new $n(f.textureWidth,f.textureHeight,{format:ri,type:Un,depthTexture:new $i(f.textureWidth,f.textureHeight,Nt,void 0,void 0,void 0,void 0,void 0,void 0,_t),stencilBuffer:y.stencil,colorSpace:t.outputColorSpace,samples:y.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let _t={antialias:y.antialias,alpha:!0,depth:y.depth,stencil:y.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,e,_t),s.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),b=new $n(d.framebufferWidth,d.framebufferHeight,{format:ri,type:Un,colorSpace:t.outputColorSpace,stencilBuffer:y.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}b.isXRRenderTarget=!0,this.setFoveation(l),c=null,a=await s.requestReferenceSpace(o),kt.setContext(s),kt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function at(et){for(let pt=0;pt<et.removed.length;pt++){let _t=et.removed[pt],Nt=T.indexOf(_t);Nt>=0&&(T[Nt]=null,E[Nt].disconnect(_t))}for(let pt=0;pt<et.added.length;pt++){let _t=et.added[pt],Nt=T.indexOf(_t);if(Nt===-1){for(let At=0;At<E.length;At++)if(At>=T.length){T.push(_t),Nt=At;break}else if(T[At]===null){T[At]=_t,Nt=At;break}if(Nt===-1)break}let lt=E[Nt];lt&&lt.connect(_t)}}function X(et,pt){pt===null?et.matrixWorld.copy(et.matrix):et.matrixWorld.multiplyMatrices(pt.matrixWorld,et.matrix),et.matrixWorldInverse.copy(et.matrixWorld).invert()}this.updateCamera=function(et){if(s===null)return;let pt=et.near,_t=et.far;p.texture!==null&&(p.depthNear>0&&(pt=p.depthNear),p.depthFar>0&&(_t=p.depthFar)),Z.near=O.near=L.near=pt,Z.far=O.far=L.far=_t,(P!==Z.near||W!==Z.far)&&(s.updateRenderState({depthNear:Z.near,depthFar:Z.far}),P=Z.near,W=Z.far),Z.layers.mask=et.layers.mask|6,L.layers.mask=Z.layers.mask&-5,O.layers.mask=Z.layers.mask&-3;let Nt=et.parent,lt=Z.cameras;X(Z,Nt);for(let At=0;At<lt.length;At++)X(lt[At],Nt);Z.projectionMatrix.copy(L.projectionMatrix),Z.projectionMatrixInverse.copy(L.projectionMatrixInverse),F===null&&et.isPerspectiveCamera&&(F={camera:et,fov:et.fov,zoom:et.zoom}),k(et,Z,Nt)};function k(et,pt,_t){_t===null?et.matrix.copy(pt.matrixWorld):(et.matrix.copy(_t.matrixWorld),et.matrix.invert(),et.matrix.multiply(pt.matrixWorld)),et.matrix.decompose(et.position,et.quaternion,et.scale),et.updateMatrixWorld(!0),et.projectionMatrix.copy(pt.projectionMatrix),et.projectionMatrixInverse.copy(pt.projectionMatrixInverse),et.isPerspectiveCamera&&(et.fov=Ur*2*Math.atan(1/et.projectionMatrix.elements[5]),et.zoom=1)}this.getCamera=function(){return Z},this.getFoveation=function(){if(!(f===null&&d===null))return l},this.setFoveation=function(et){l=et,f!==null&&(f.fixedFoveation=et),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=et)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(Z)},this.getCameraTexture=function(et){return g[et]};let it=null;function Tt(et,pt){if(h=pt.getViewerPose(c||a),m=pt,h!==null){let _t=h.views;d!==null&&(t.setRenderTargetFramebuffer(b,d.framebuffer),t.setRenderTarget(b));let Nt=!1;_t.length!==Z.cameras.length&&(Z.cameras.length=0,Nt=!0);for(let Ft=0;Ft<_t.length;Ft++){let ee=_t[Ft],_e=null;if(d!==null)_e=d.getViewport(ee);else{let Ge=u.getViewSubImage(f,ee);_e=Ge.viewport,Ft===0&&(t.setRenderTargetTextures(b,Ge.colorTexture,Ge.depthStencilTexture),t.setRenderTarget(b))}let Qt=H[Ft];Qt===void 0&&(Qt=new Rn,Qt.layers.enable(Ft),Qt.viewport=new be,H[Ft]=Qt),Qt.matrix.fromArray(ee.transform.matrix),Qt.matrix.decompose(Qt.position,Qt.quaternion,Qt.scale),Qt.projectionMatrix.fromArray(ee.projectionMatrix),Qt.projectionMatrixInverse.copy(Qt.projectionMatrix).invert(),Qt.viewport.set(_e.x,_e.y,_e.width,_e.height),Ft===0&&(Z.matrix.copy(Qt.matrix),Z.matrix.decompose(Z.position,Z.quaternion,Z.scale)),Nt===!0&&Z.cameras.push(Qt)}let lt=s.enabledFeatures;if(lt&&lt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){u=n.getBinding();let Ft=u.getDepthInformation(_t[0]);Ft&&Ft.isValid&&Ft.texture&&p.init(Ft,s.renderState)}if(lt&&lt.includes("camera-access")&&_){t.state.unbindTexture(),u=n.getBinding();for(let Ft=0;Ft<_t.length;Ft++){let ee=_t[Ft].camera;if(ee){let _e=g[ee];_e||(_e=new ja,g[ee]=_e);let Qt=u.getCameraImage(ee);_e.sourceTexture=Qt}}}}for(let _t=0;_t<E.length;_t++){let Nt=T[_t],lt=E[_t];Nt!==null&&lt!==void 0&&lt.update(Nt,pt,c||a)}it&&it(et,pt),pt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:pt}),m=null}let kt=new d_;kt.setAnimationLoop(Tt),this.setAnimationLoop=function(et){it=et},this.dispose=function(){}}},eA=new re,w_=new $t;w_.set(-1,0,0,0,1,0,0,0,1);function nA(i,t){function e(p,g){p.matrixAutoUpdate===!0&&p.updateMatrix(),g.value.copy(p.matrix)}function n(p,g){g.color.getRGB(p.fogColor.value,ld(i)),g.isFog?(p.fogNear.value=g.near,p.fogFar.value=g.far):g.isFogExp2&&(p.fogDensity.value=g.density)}function s(p,g,y,w,b){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(p,g):g.isMeshLambertMaterial?(r(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(p,g),u(p,g)):g.isMeshPhongMaterial?(r(p,g),h(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(p,g),f(p,g),g.isMeshPhysicalMaterial&&d(p,g,b)):g.isMeshMatcapMaterial?(r(p,g),m(p,g)):g.isMeshDepthMaterial?r(p,g):g.isMeshDistanceMaterial?(r(p,g),_(p,g)):g.isMeshNormalMaterial?r(p,g):g.isLineBasicMaterial?(a(p,g),g.isLineDashedMaterial&&o(p,g)):g.isPointsMaterial?l(p,g,y,w):g.isSpriteMaterial?c(p,g):g.isShadowMaterial?(p.color.value.copy(g.color),p.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(p,g){p.opacity.value=g.opacity,g.color&&p.diffuse.value.copy(g.color),g.emissive&&p.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.bumpMap&&(p.bumpMap.value=g.bumpMap,e(g.bumpMap,p.bumpMapTransform),p.bumpScale.value=g.bumpScale,g.side===In&&(p.bumpScale.value*=-1)),g.normalMap&&(p.normalMap.value=g.normalMap,e(g.normalMap,p.normalMapTransform),p.normalScale.value.copy(g.normalScale),g.side===In&&p.normalScale.value.negate()),g.displacementMap&&(p.displacementMap.value=g.displacementMap,e(g.displacementMap,p.displacementMapTransform),p.displacementScale.value=g.displacementScale,p.displacementBias.value=g.displacementBias),g.emissiveMap&&(p.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,p.emissiveMapTransform)),g.specularMap&&(p.specularMap.value=g.specularMap,e(g.specularMap,p.specularMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest);let y=t.get(g),w=y.envMap,b=y.envMapRotation;w&&(p.envMap.value=w,p.envMapRotation.value.setFromMatrix4(eA.makeRotationFromEuler(b)).transpose(),w.isCubeTexture&&w.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(w_),p.reflectivity.value=g.reflectivity,p.ior.value=g.ior,p.refractionRatio.value=g.refractionRatio),g.lightMap&&(p.lightMap.value=g.lightMap,p.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,p.lightMapTransform)),g.aoMap&&(p.aoMap.value=g.aoMap,p.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,p.aoMapTransform))}function a(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform))}function o(p,g){p.dashSize.value=g.dashSize,p.totalSize.value=g.dashSize+g.gapSize,p.scale.value=g.scale}function l(p,g,y,w){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.size.value=g.size*y,p.scale.value=w*.5,g.map&&(p.map.value=g.map,e(g.map,p.uvTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function c(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.rotation.value=g.rotation,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function h(p,g){p.specular.value.copy(g.specular),p.shininess.value=Math.max(g.shininess,1e-4)}function u(p,g){g.gradientMap&&(p.gradientMap.value=g.gradientMap)}function f(p,g){p.metalness.value=g.metalness,g.metalnessMap&&(p.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,p.metalnessMapTransform)),p.roughness.value=g.roughness,g.roughnessMap&&(p.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,p.roughnessMapTransform)),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)}function d(p,g,y){p.ior.value=g.ior,g.diffuseRoughness>0&&(p.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),g.sheen>0&&(p.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),p.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(p.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,p.sheenColorMapTransform)),g.sheenRoughnessMap&&(p.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,p.sheenRoughnessMapTransform))),g.clearcoat>0&&(p.clearcoat.value=g.clearcoat,p.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(p.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,p.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(p.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===In&&p.clearcoatNormalScale.value.negate())),g.dispersion>0&&(p.dispersion.value=g.dispersion),g.retroreflectivity>0&&(p.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(p.iridescence.value=g.iridescence,p.iridescenceIOR.value=g.iridescenceIOR,p.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(p.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,p.iridescenceMapTransform)),g.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),g.transmission>0&&(p.transmission.value=g.transmission,p.transmissionSamplerMap.value=y.texture,p.transmissionSamplerSize.value.set(y.width,y.height),g.transmissionMap&&(p.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,p.transmissionMapTransform)),p.thickness.value=g.thickness,g.thicknessMap&&(p.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=g.attenuationDistance,p.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(p.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(p.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=g.specularIntensity,p.specularColor.value.copy(g.specularColor),g.specularColorMap&&(p.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,p.specularColorMapTransform)),g.specularIntensityMap&&(p.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,p.specularIntensityMapTransform))}function m(p,g){g.matcap&&(p.matcap.value=g.matcap)}function _(p,g){let y=t.get(g).light;p.referencePosition.value.setFromMatrixPosition(y.matrixWorld),p.nearDistance.value=y.shadow.camera.near,p.farDistance.value=y.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function iA(i,t,e,n){let s={},r={};function a(y,w){let b=w.program;n.uniformBlockBinding(y,b,s[y.id])}function o(y,w){let b=s[y.id];b===void 0&&(m(y),b=l(y),s[y.id]=b,y.addEventListener("dispose",p));let E=w.program;n.updateUBOMapping(y,E);let T=t.render.frame;r[y.id]!==T&&(c(y),r[y.id]=T)}function l(y){let w=i.createBuffer(),b=y.__size,E=y.usage;return i.bindBuffer(i.UNIFORM_BUFFER,w),i.bufferData(i.UNIFORM_BUFFER,b,E),i.bindBuffer(i.UNIFORM_BUFFER,null),w}function c(y){let w=s[y.id],b=y.uniforms,E=y.__cache;i.bindBuffer(i.UNIFORM_BUFFER,w);for(let T=0,x=b.length;T<x;T++){let A=b[T];if(Array.isArray(A))for(let F=0,L=A.length;F<L;F++)h(A[F],T,F,E);else h(A,T,0,E)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(y,w,b,E){if(f(y,w,b,E)===!0){let T=y.__offset,x=y.value;if(Array.isArray(x)){let A=0;for(let F=0;F<x.length;F++){let L=x[F],O=_(L,!0);u(L,y.__data,A),A+=O.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,y.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,T,y.__data)}}function u(y,w,b){typeof y=="number"||typeof y=="boolean"?w[b]=y:y.isMatrix3?(w[b]=y.elements[0],w[b+1]=y.elements[1],w[b+2]=y.elements[2],w[b+3]=0,w[b+4]=y.elements[3],w[b+5]=y.elements[4],w[b+6]=y.elements[5],w[b+7]=0,w[b+8]=y.elements[6],w[b+9]=y.elements[7],w[b+10]=y.elements[8],w[b+11]=0):ArrayBuffer.isView(y)?w.set(y.subarray(0,w.length-b),b):y.toArray(w,b)}function f(y,w,b,E){let T=y.value,x=w+"_"+b;if(Array.isArray(T)){E[x]===void 0&&(E[x]=[]);let A=E[x],F=!1;for(let L=0;L<T.length;L++)d(T[L],A,L)===!0&&(F=!0);return F}return d(T,E,x)}function d(y,w,b){if(w[b]===void 0)return typeof y=="number"||typeof y=="boolean"?w[b]=y:ArrayBuffer.isView(y)?w[b]=y.slice():w[b]=y.clone(),!0;{let E=w[b];if(typeof y=="number"||typeof y=="boolean"){if(E!==y)return w[b]=y,!0}else{if(ArrayBuffer.isView(y))return!0;if(E.equals(y)===!1)return E.copy(y),!0}}return!1}function m(y){let w=y.uniforms,b=0,E=16;for(let x=0,A=w.length;x<A;x++){let F=Array.isArray(w[x])?w[x]:[w[x]];for(let L=0,O=F.length;L<O;L++){let H=F[L],Z=Array.isArray(H.value)?H.value:[H.value],P=Array.isArray(w[x])||Array.isArray(H.value),W=b;for(let $=0,at=Z.length;$<at;$++){let X=Z[$],k=_(X,P),it=b%E,Tt=it%k.boundary,kt=it+Tt;b+=Tt,kt!==0&&E-kt<k.storage&&(b+=E-kt),$===0&&(W=b),b+=k.storage}let tt=H.type==="int"?Int32Array:H.type==="uint"?Uint32Array:Float32Array;H.__data=new tt((b-W)/Float32Array.BYTES_PER_ELEMENT),H.__offset=W}}let T=b%E;return T>0&&(b+=E-T),y.__size=b,y.__cache={},this}function _(y,w){let b={boundary:0,storage:0};return typeof y=="number"||typeof y=="boolean"?(b.boundary=4,b.storage=4):y.isVector2?(b.boundary=8,b.storage=8):y.isVector3||y.isColor?(b.boundary=16,b.storage=12):y.isVector4?(b.boundary=16,b.storage=16):y.isMatrix3?(b.boundary=16,b.storage=48):y.isMatrix4?(b.boundary=16,b.storage=64):y.isTexture?Ut("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(y)?(b.boundary=16,b.storage=y.byteLength):Ut("WebGLRenderer: Unsupported uniform value type.",y),w===!0&&(b.boundary=16,b.storage=Math.ceil(b.storage/16)*16),b}function p(y){let w=y.target;w.removeEventListener("dispose",p),i.deleteBuffer(s[w.id]),delete s[w.id],delete r[w.id]}function g(){for(let y in s)i.deleteBuffer(s[y]);s={},r={}}return{bind:a,update:o,dispose:g}}var sA=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Ti=null;function rA(){return Ti===null&&(Ti=new qa(sA,16,16,ys,mi),Ti.name="DFG_LUT",Ti.minFilter=Cn,Ti.magFilter=Cn,Ti.wrapS=bi,Ti.wrapT=bi,Ti.generateMipmaps=!1,Ti.needsUpdate=!0),Ti}var uh=class{constructor(t={}){let{canvas:e=U0(),context:n=null,depth:s=!0,stencil:r=!1,alpha:a=!1,antialias:o=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:f=!1,outputBufferType:d=Un}=t;this.isWebGLRenderer=!0;let m;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=n.getContextAttributes().alpha}else m=a;let _=d,p=new Set([Pc,Cc,Rc]),g=new Set([Un,pi,Zr,$s,Ac,Tc]),y=new Uint32Array(4),w=new Int32Array(4),b={textures:[],min:[],max:[],resolution:[]},E=null,T=null,x=[],A=[],F=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Ai,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let L=this,O=!1,H=null,Z=null,P=null,W=null;this._outputColorSpace=yn;let tt=0,$=0,at=null,X=-1,k=null,it=new be,Tt=new be,kt=null,et=new Jt(0),pt=0,_t=e.width,Nt=e.height,lt=1,At=null,ae=null,Ft=new be(0,0,_t,Nt),ee=new be(0,0,_t,Nt),_e=!1,Qt=new hs,Ge=new ic,Ue=!1,fn=!1,ye=new re,oe=new B,Be=new be,Mn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},pn=!1;function ze(){return at===null?lt:1}let D=n;function bn(S,N){return e.getContext(S,N)}let pe,Ae,Mt,ke,Bt,Gt,C,M,G,ot,st,ut,yt,j,Q,ft,I,nt,J,mt,ht,dt,Dt;try{let S={alpha:!0,depth:s,stencil:r,antialias:o,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Ot,!1),e.addEventListener("webglcontextrestored",Zt,!1),e.addEventListener("webglcontextcreationerror",bt,!1),D===null){let N="webgl2";if(D=bn(N,S),D===null)throw bn(N)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Kt()}catch(S){throw e.removeEventListener("webglcontextlost",Ot,!1),e.removeEventListener("webglcontextrestored",Zt,!1),e.removeEventListener("webglcontextcreationerror",bt,!1),Ht("WebGLRenderer: "+S.message),S}function Kt(){pe=new g1(D),pe.init(),ht=new jE(D,pe),Ae=new r1(D,pe,t,ht),Mt=new JE(D,pe),Ae.reversedDepthBuffer&&f&&Mt.buffers.depth.setReversed(!0),Z=D.createFramebuffer(),P=D.createFramebuffer(),W=D.createFramebuffer(),ke=new x1(D),Bt=new UE,Gt=new KE(D,pe,Mt,Bt,Ae,ht,ke),C=new m1(L),M=new Mb(D),dt=new i1(D,M),G=new _1(D,M,ke,dt),ot=new M1(D,G,M,dt,ke),nt=new v1(D,Ae,Gt),Q=new a1(Bt),st=new OE(L,C,pe,Ae,dt,Q),ut=new nA(L,Bt),yt=new BE,j=new WE(pe),I=new n1(L,C,Mt,ot,m,l),ft=new ZE(L,ot,Ae),Dt=new iA(D,ke,Ae,Mt),J=new s1(D,pe,ke),mt=new y1(D,pe,ke),ke.programs=st.programs,L.capabilities=Ae,L.extensions=pe,L.properties=Bt,L.renderLists=yt,L.shadowMap=ft,L.state=Mt,L.info=ke}_!==Un&&(F=new w1(_,e.width,e.height,o,s,r));let ct=new Md(L,D);this.xr=ct,this.getContext=function(){return D},this.getContextAttributes=function(){return D.getContextAttributes()},this.forceContextLoss=function(){let S=pe.get("WEBGL_lose_context");S&&S.loseContext()},this.forceContextRestore=function(){let S=pe.get("WEBGL_lose_context");S&&S.restoreContext()},this.getPixelRatio=function(){return lt},this.setPixelRatio=function(S){S!==void 0&&(lt=S,this.setSize(_t,Nt,!1))},this.getSize=function(S){return S.set(_t,Nt)},this.setSize=function(S,N,q=!0){if(ct.isPresenting){Ut("WebGLRenderer: Can't change size while VR device is presenting.");return}_t=S,Nt=N,e.width=Math.floor(S*lt),e.height=Math.floor(N*lt),q===!0&&(e.style.width=S+"px",e.style.height=N+"px"),F!==null&&F.setSize(e.width,e.height),this.setViewport(0,0,S,N)},this.getDrawingBufferSize=function(S){return S.set(_t*lt,Nt*lt).floor()},this.setDrawingBufferSize=function(S,N,q){_t=S,Nt=N,lt=q,e.width=Math.floor(S*q),e.height=Math.floor(N*q),this.setViewport(0,0,S,N)},this.setEffects=function(S){if(_===Un){Ht("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(S){for(let N=0;N<S.length;N++)if(S[N].isOutputPass===!0){Ut("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}F.setEffects(S||[])},this.getCurrentViewport=function(S){return S.copy(it)},this.getViewport=function(S){return S.copy(Ft)},this.setViewport=function(S,N,q,z){S.isVector4?Ft.set(S.x,S.y,S.z,S.w):Ft.set(S,N,q,z),Mt.viewport(it.copy(Ft).multiplyScalar(ze()).round())},this.getScissor=function(S){return S.copy(ee)},this.setScissor=function(S,N,q,z){S.isVector4?ee.set(S.x,S.y,S.z,S.w):ee.set(S,N,q,z),Mt.scissor(Tt.copy(ee).multiplyScalar(ze()).round())},this.getScissorTest=function(){return _e},this.setScissorTest=function(S){Mt.setScissorTest(_e=S)},this.setOpaqueSort=function(S){At=S},this.setTransparentSort=function(S){ae=S},this.getClearColor=function(S){return S.copy(I.getClearColor())},this.setClearColor=function(){I.setClearColor(...arguments)},this.getClearAlpha=function(){return I.getClearAlpha()},this.setClearAlpha=function(){I.setClearAlpha(...arguments)},this.clear=function(S=!0,N=!0,q=!0){let z=0;if(S){let V=!1;if(at!==null){let gt=at.texture.format;V=p.has(gt)}if(V){let gt=at.texture.type,Rt=g.has(gt),xt=I.getClearColor(),wt=I.getClearAlpha(),Lt=xt.r,Xt=xt.g,ne=xt.b;Rt?(y[0]=Lt,y[1]=Xt,y[2]=ne,y[3]=wt,D.clearBufferuiv(D.COLOR,0,y)):(w[0]=Lt,w[1]=Xt,w[2]=ne,w[3]=wt,D.clearBufferiv(D.COLOR,0,w))}else z|=D.COLOR_BUFFER_BIT}N&&(z|=D.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),q&&(z|=D.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),z!==0&&D.clear(z)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(S){S.setRenderer(this),H=S},this.dispose=function(){e.removeEventListener("webglcontextlost",Ot,!1),e.removeEventListener("webglcontextrestored",Zt,!1),e.removeEventListener("webglcontextcreationerror",bt,!1),I.dispose(),yt.dispose(),j.dispose(),Gt.dispose(),Bt.dispose(),C.dispose(),ot.dispose(),G.dispose(),dt.dispose(),Dt.dispose(),st.dispose(),ct.dispose(),ct.removeEventListener("sessionstart",bo),ct.removeEventListener("sessionend",Js),Ci.stop()};function Ot(S){S.preventDefault(),id("WebGLRenderer: Context Lost."),O=!0}function Zt(){id("WebGLRenderer: Context Restored."),O=!1;let S=ke.autoReset,N=ft.enabled,q=ft.autoUpdate,z=ft.needsUpdate,V=ft.type;Kt(),ke.autoReset=S,ft.enabled=N,ft.autoUpdate=q,ft.needsUpdate=z,ft.type=V}function bt(S){Ht("WebGLRenderer: A WebGL context could not be created. Reason: ",S.statusMessage)}function me(S){let N=S.target;N.removeEventListener("dispose",me),Ve(N)}function Ve(S){gi(S),Bt.remove(S)}function gi(S){let N=Bt.get(S).programs;N!==void 0&&(N.forEach(function(q){st.releaseProgram(q)}),S.isShaderMaterial&&st.releaseShaderCache(S))}this.renderBufferDirect=function(S,N,q,z,V,gt){N===null&&(N=Mn);let Rt=V.isMesh&&V.matrixWorld.determinantAffine()<0,xt=Ao(S,N,q,z,V);Mt.setMaterial(z,Rt);let wt=q.index,Lt=1;if(z.wireframe===!0){if(wt=G.getWireframeAttribute(q),wt===void 0)return;Lt=2}let Xt=q.drawRange,ne=q.attributes.position,Ct=Xt.start*Lt,ie=(Xt.start+Xt.count)*Lt;gt!==null&&(Ct=Math.max(Ct,gt.start*Lt),ie=Math.min(ie,(gt.start+gt.count)*Lt)),wt!==null?(Ct=Math.max(Ct,0),ie=Math.min(ie,wt.count)):ne!=null&&(Ct=Math.max(Ct,0),ie=Math.min(ie,ne.count));let Ie=ie-Ct;if(Ie<0||Ie===1/0)return;dt.setup(V,z,xt,q,wt);let fe,xe=J;if(wt!==null&&(fe=M.get(wt),xe=mt,xe.setIndex(fe)),V.isMesh)z.wireframe===!0?(Mt.setLineWidth(z.wireframeLinewidth*ze()),xe.setMode(D.LINES)):xe.setMode(D.TRIANGLES);else if(V.isLine){let sn=z.linewidth;sn===void 0&&(sn=1),Mt.setLineWidth(sn*ze()),V.isLineSegments?xe.setMode(D.LINES):V.isLineLoop?xe.setMode(D.LINE_LOOP):xe.setMode(D.LINE_STRIP)}else V.isPoints?xe.setMode(D.POINTS):V.isSprite&&xe.setMode(D.TRIANGLES);if(V.isBatchedMesh)if(pe.get("WEBGL_multi_draw"))xe.renderMultiDraw(V._multiDrawStarts,V._multiDrawCounts,V._multiDrawCount);else{let sn=V._multiDrawStarts,Pt=V._multiDrawCounts,qe=V._multiDrawCount,he=wt?M.get(wt).bytesPerElement:1,_i=Bt.get(z).currentProgram.getUniforms();for(let Ye=0;Ye<qe;Ye++)_i.setValue(D,"_gl_DrawID",Ye),xe.render(sn[Ye]/he,Pt[Ye])}else if(V.isInstancedMesh)xe.renderInstances(Ct,Ie,V.count);else if(q.isInstancedBufferGeometry){let sn=q._maxInstanceCount!==void 0?q._maxInstanceCount:1/0,Pt=Math.min(q.instanceCount,sn);xe.renderInstances(Ct,Ie,Pt)}else xe.render(Ct,Ie)};function jr(S,N,q,z){H!==null&&S.isNodeMaterial&&H.setObject(z,S),Ue===!0&&Q.setState(S,q,!1),S.transparent===!0&&S.side===Ei&&S.forceSinglePass===!1?(S.side=In,S.needsUpdate=!0,Ji(S,N,z),S.side=_s,S.needsUpdate=!0,Ji(S,N,z),S.side=Ei):Ji(S,N,z)}this.compile=function(S,N,q=null){q===null&&(q=S),H!==null&&H.renderStart(S,N,q),T=j.get(q),T.init(N),A.push(T),q.traverseVisible(function(V){V.isLight&&V.layers.test(N.layers)&&(T.pushLight(V),V.castShadow&&T.pushShadow(V))}),S!==q&&S.traverseVisible(function(V){V.isLight&&V.layers.test(N.layers)&&(T.pushLight(V),V.castShadow&&T.pushShadow(V))}),T.setupLights(),H!==null&&H.updateLights(T.state.lightsArray),fn=this.localClippingEnabled,Ue=Q.init(this.clippingPlanes,fn),Ue===!0&&Q.setGlobalState(this.clippingPlanes,N),H!==null&&ft.render(T.state.shadowsArray,q,N);let z=new Set;return S.traverse(function(V){if(!(V.isMesh||V.isPoints||V.isLine||V.isSprite))return;let gt=V.material;if(gt)if(Array.isArray(gt))for(let Rt=0;Rt<gt.length;Rt++){let xt=gt[Rt];jr(xt,q,N,V),z.add(xt)}else jr(gt,q,N,V),z.add(gt)}),T=A.pop(),H!==null&&H.renderEnd(),z},this.compileAsync=function(S,N,q=null){let z=this.compile(S,N,q);return new Promise(V=>{function gt(){if(z.forEach(function(Rt){let wt=Bt.get(Rt).currentProgram;(wt===void 0||wt.isReady())&&z.delete(Rt)}),z.size===0){V(S);return}setTimeout(gt,10)}pe.get("KHR_parallel_shader_compile")!==null?gt():setTimeout(gt,10)})};let xs=null;function Zs(S){xs&&xs(S)}function bo(){Ci.stop()}function Js(){Ci.start()}let Ci=new d_;Ci.setAnimationLoop(Zs),typeof self<"u"&&Ci.setContext(self),this.setAnimationLoop=function(S){xs=S,ct.setAnimationLoop(S),S===null?Ci.stop():Ci.start()},ct.addEventListener("sessionstart",bo),ct.addEventListener("sessionend",Js),this.render=function(S,N){if(N!==void 0&&N.isCamera!==!0){Ht("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(O===!0)return;H!==null&&H.renderStart(S,N);let q=ct.enabled===!0&&ct.isPresenting===!0,z=F!==null&&(at===null||q)&&F.begin(L,at);if(S.matrixWorldAutoUpdate===!0&&S.updateMatrixWorld(),N.parent===null&&N.matrixWorldAutoUpdate===!0&&N.updateMatrixWorld(),ct.enabled===!0&&ct.isPresenting===!0&&(F===null||F.isCompositing()===!1)&&(ct.cameraAutoUpdate===!0&&ct.updateCamera(N),N=ct.getCamera()),S.isScene===!0&&S.onBeforeRender(L,S,N,at),T=j.get(S,A.length),T.init(N),T.state.textureUnits=Gt.getTextureUnits(),A.push(T),ye.multiplyMatrices(N.projectionMatrix,N.matrixWorldInverse),N.isArrayCamera?Ge.setFromArrayCamera(N):Qt.setFromProjectionMatrix(ye,ii,N.reversedDepth),fn=this.localClippingEnabled,Ue=Q.init(this.clippingPlanes,fn),E=yt.get(S,x.length),E.init(),x.push(E),this.info.render.frame++,ct.enabled===!0&&ct.isPresenting===!0){let Rt=L.xr.getDepthSensingMesh();Rt!==null&&Qr(Rt,N,-1/0,L.sortObjects)}Qr(S,N,0,L.sortObjects),E.finish(),H!==null&&H.updateLights(T.state.lightsArray),L.sortObjects===!0&&E.sort(At,ae),pn=ct.enabled===!1||ct.isPresenting===!1||ct.hasDepthSensing()===!1,pn&&I.addToRenderList(E,S),this.info.autoReset===!0&&this.info.reset(),Ue===!0&&Q.beginShadows();let V=T.state.shadowsArray;if(ft.render(V,S,N),Ue===!0&&Q.endShadows(),(z&&F.hasRenderPass())===!1){let Rt=E.opaque,xt=E.transmissive;if(T.setupLights(),N.isArrayCamera){let wt=N.cameras;if(xt.length>0)for(let Lt=0,Xt=wt.length;Lt<Xt;Lt++){let ne=wt[Lt];So(Rt,xt,S,ne)}pn&&I.render(S);for(let Lt=0,Xt=wt.length;Lt<Xt;Lt++){let ne=wt[Lt];wo(E,S,ne,ne.viewport)}}else xt.length>0&&So(Rt,xt,S,N),pn&&I.render(S),wo(E,S,N)}at!==null&&$===0&&(Gt.updateMultisampleRenderTarget(at),Gt.updateRenderTargetMipmap(at)),z&&F.end(L),S.isScene===!0&&S.onAfterRender(L,S,N),dt.resetDefaultState(),X=-1,k=null,A.pop(),A.length>0?(T=A[A.length-1],Gt.setTextureUnits(T.state.textureUnits),Ue===!0&&Q.setGlobalState(L.clippingPlanes,T.state.camera)):T=null,x.pop(),x.length>0?E=x[x.length-1]:E=null,H!==null&&H.renderEnd()};function Qr(S,N,q,z){if(S.visible===!1)return;if(S.layers.test(N.layers)){if(S.isGroup)q=S.renderOrder;else if(S.isLOD)S.autoUpdate===!0&&S.update(N);else if(S.isLight)T.pushLight(S),S.castShadow&&T.pushShadow(S);else if(S.isSprite){let Rt=N.isArrayCamera?Ge:Qt;if(!S.frustumCulled||S.intersectsFrustum(Rt)){z&&Be.setFromMatrixPosition(S.matrixWorld).applyMatrix4(ye);let xt=ot.update(S),wt=S.material;wt.visible&&E.push(S,xt,wt,q,Be.z,null,N)}}else if(S.isMesh||S.isLine||S.isPoints){let Rt=N.isArrayCamera?Ge:Qt;if(!S.frustumCulled||S.intersectsFrustum(Rt)){let xt=ot.update(S),wt=S.material;if(z&&(S.boundingSphere!==void 0?(S.boundingSphere===null&&S.computeBoundingSphere(),Be.copy(S.boundingSphere.center)):(xt.boundingSphere===null&&xt.computeBoundingSphere(),Be.copy(xt.boundingSphere.center)),Be.applyMatrix4(S.matrixWorld).applyMatrix4(ye)),Array.isArray(wt)){let Lt=xt.groups;for(let Xt=0,ne=Lt.length;Xt<ne;Xt++){let Ct=Lt[Xt],ie=wt[Ct.materialIndex];ie&&ie.visible&&E.push(S,xt,ie,q,Be.z,Ct,N)}}else wt.visible&&E.push(S,xt,wt,q,Be.z,null,N)}}}let gt=S.children;for(let Rt=0,xt=gt.length;Rt<xt;Rt++)Qr(gt[Rt],N,q,z)}function wo(S,N,q,z){let{opaque:V,transmissive:gt,transparent:Rt}=S;T.setupLightsView(q),Ue===!0&&Q.setGlobalState(L.clippingPlanes,q),z&&Mt.viewport(it.copy(z)),V.length>0&&Ks(V,N,q),gt.length>0&&Ks(gt,N,q),Rt.length>0&&Ks(Rt,N,q),Mt.buffers.depth.setTest(!0),Mt.buffers.depth.setMask(!0),Mt.buffers.color.setMask(!0),Mt.setPolygonOffset(!1)}function So(S,N,q,z){if((q.isScene===!0?q.overrideMaterial:null)!==null)return;if(T.state.transmissionRenderTarget[z.id]===void 0){let Ct=pe.has("EXT_color_buffer_half_float")||pe.has("EXT_color_buffer_float");T.state.transmissionRenderTarget[z.id]=new $n(1,1,{generateMipmaps:!0,type:Ct?mi:Un,minFilter:qi,samples:Math.max(4,Ae.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:ce.workingColorSpace})}let gt=T.state.transmissionRenderTarget[z.id],Rt=z.viewport||it;gt.setSize(Rt.z*L.transmissionResolutionScale,Rt.w*L.transmissionResolutionScale);let xt=L.getRenderTarget(),wt=L.getActiveCubeFace(),Lt=L.getActiveMipmapLevel();L.setRenderTarget(gt),L.getClearColor(et),pt=L.getClearAlpha(),pt<1&&L.setClearColor(16777215,.5),L.clear(),pn&&I.render(q);let Xt=L.toneMapping;L.toneMapping=Ai;let ne=z.viewport;if(z.viewport!==void 0&&(z.viewport=void 0),T.setupLightsView(z),Ue===!0&&Q.setGlobalState(L.clippingPlanes,z),Ks(S,q,z),Gt.updateMultisampleRenderTarget(gt),Gt.updateRenderTargetMipmap(gt),pe.has("WEBGL_multisampled_render_to_texture")===!1){let Ct=!1;for(let ie=0,Ie=N.length;ie<Ie;ie++){let fe=N[ie],{object:xe,geometry:sn,material:Pt,group:qe}=fe;if(Pt.side===Ei&&xe.layers.test(z.layers)){let he=Pt.side;Pt.side=In,Pt.needsUpdate=!0,ta(xe,q,z,sn,Pt,qe),Pt.side=he,Pt.needsUpdate=!0,Ct=!0}}Ct===!0&&(Gt.updateMultisampleRenderTarget(gt),Gt.updateRenderTargetMipmap(gt))}L.setRenderTarget(xt,wt,Lt),L.setClearColor(et,pt),ne!==void 0&&(z.viewport=ne),L.toneMapping=Xt}function Ks(S,N,q){let z=N.isScene===!0?N.overrideMaterial:null;for(let V=0,gt=S.length;V<gt;V++){let Rt=S[V],{object:xt,geometry:wt,group:Lt}=Rt,Xt=Rt.material;Xt.allowOverride===!0&&z!==null&&(Xt=z),xt.layers.test(q.layers)&&ta(xt,N,q,wt,Xt,Lt)}}function ta(S,N,q,z,V,gt){H!==null&&V.isNodeMaterial&&H.setObject(S,V),S.onBeforeRender(L,N,q,z,V,gt),S.modelViewMatrix.multiplyMatrices(q.matrixWorldInverse,S.matrixWorld),S.normalMatrix.getNormalMatrix(S.modelViewMatrix),V.onBeforeRender(L,N,q,z,S,gt),V.transparent===!0&&V.side===Ei&&V.forceSinglePass===!1?(V.side=In,V.needsUpdate=!0,L.renderBufferDirect(q,N,z,V,S,gt),V.side=_s,V.needsUpdate=!0,L.renderBufferDirect(q,N,z,V,S,gt),V.side=Ei):L.renderBufferDirect(q,N,z,V,S,gt),S.onAfterRender(L,N,q,z,V,gt)}function ea(S){let N=0;for(let q of S)q.texture!==null&&N++;return N}function Ji(S,N,q){N.isScene!==!0&&(N=Mn);let z=Bt.get(S),V=T.state.lights,gt=T.state.shadowsArray,Rt=V.state.version,xt=st.getParameters(S,V.state,gt,N,q,T.state.lightProbeGridArray),wt=st.getProgramCacheKey(xt),Lt=z.programs;z.environment=S.isMeshStandardMaterial||S.isMeshLambertMaterial||S.isMeshPhongMaterial?N.environment:null,z.fog=N.fog;let Xt=S.isMeshStandardMaterial||S.isMeshLambertMaterial&&!S.envMap||S.isMeshPhongMaterial&&!S.envMap;z.envMap=C.get(S.envMap||z.environment,Xt),z.envMapRotation=z.environment!==null&&S.envMap===null?N.environmentRotation:S.envMapRotation,Lt===void 0&&(S.addEventListener("dispose",me),Lt=new Map,z.programs=Lt,z.programVariants=new Map);let ne=Lt.get(wt);if(ne!==void 0){if(z.currentProgram===ne&&z.lightsStateVersion===Rt)return na(S,xt),ne}else xt.uniforms=st.getUniforms(S),H!==null&&S.isNodeMaterial&&H.build(S,q,xt),S.onBeforeCompile(xt,L),ne=st.acquireProgram(xt,wt),Lt.set(wt,ne),z.uniforms=xt.uniforms;let Ct=z.uniforms;return(!S.isShaderMaterial&&!S.isRawShaderMaterial||S.clipping===!0)&&(Ct.clippingPlanes=Q.uniform),na(S,xt),z.needsLights=vh(S),z.lightsStateVersion=Rt,z.needsLights&&(Ct.ambientLightColor.value=V.state.ambient,Ct.lightProbe.value=V.state.probe,Ct.sunLights.value=V.state.sun,Ct.sunLightShadows.value=V.state.sunShadow,Ct.directionalLights.value=V.state.directional,Ct.directionalLightShadows.value=V.state.directionalShadow,Ct.spotLights.value=V.state.spot,Ct.spotLightShadows.value=V.state.spotShadow,Ct.rectAreaLights.value=V.state.rectArea,Ct.ltc_1.value=V.state.rectAreaLTC1,Ct.ltc_2.value=V.state.rectAreaLTC2,Ct.pointLights.value=V.state.point,Ct.pointLightShadows.value=V.state.pointShadow,Ct.hemisphereLights.value=V.state.hemi,Ct.sunShadowMatrix.value=V.state.sunShadowMatrix,Ct.sunShadowCascade.value=V.state.sunShadowCascade,Ct.directionalShadowMatrix.value=V.state.directionalShadowMatrix,Ct.spotLightMatrix.value=V.state.spotLightMatrix,Ct.spotLightMap.value=V.state.spotLightMap,Ct.pointShadowMatrix.value=V.state.pointShadowMatrix),z.numLightProbeGrids=ea(T.state.lightProbeGridArray),z.currentProgram=ne,z.uniformsList=null,ne}function xh(S,N,q,z,V){let gt=Bt.get(S),Rt=gt.currentProgram.id+","+z+","+V,xt=gt.programVariants.get(Rt);return xt===void 0?(xt=Ji(S,N,q),gt.programVariants.set(Rt,xt)):(gt.currentProgram=xt,gt.uniformsList=null,gt.outputColorSpace=z,gt.toneMapping=V),xt}function Eo(S){if(S.uniformsList===null){let N=S.currentProgram.getUniforms();S.uniformsList=Jr.seqWithValue(N.seq,S.uniforms)}return S.uniformsList}function na(S,N){let q=Bt.get(S);q.outputColorSpace=N.outputColorSpace,q.batching=N.batching,q.batchingColor=N.batchingColor,q.instancing=N.instancing,q.instancingColor=N.instancingColor,q.instancingMorph=N.instancingMorph,q.skinning=N.skinning,q.morphTargets=N.morphTargets,q.morphNormals=N.morphNormals,q.morphColors=N.morphColors,q.morphTargetsCount=N.morphTargetsCount,q.numClippingPlanes=N.numClippingPlanes,q.numIntersection=N.numClipIntersection,q.vertexAlphas=N.vertexAlphas,q.vertexTangents=N.vertexTangents,q.toneMapping=N.toneMapping}function Ao(S,N,q,z,V){N.isScene!==!0&&(N=Mn),Gt.resetTextureUnits();let gt=N.fog,Rt=z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial?N.environment:null,xt=at===null?L.outputColorSpace:at.isXRRenderTarget===!0?at.texture.colorSpace:ce.workingColorSpace,wt=z.isMeshStandardMaterial||z.isMeshLambertMaterial&&!z.envMap||z.isMeshPhongMaterial&&!z.envMap,Lt=C.get(z.envMap||Rt,wt),Xt=z.vertexColors===!0&&!!q.attributes.color&&q.attributes.color.itemSize===4,ne=!!q.attributes.tangent&&(!!z.normalMap||z.anisotropy>0),Ct=!!q.morphAttributes.position,ie=!!q.morphAttributes.normal,Ie=!!q.morphAttributes.color,fe=Ai;z.toneMapped&&(at===null||at.isXRRenderTarget===!0)&&(fe=L.toneMapping);let xe=q.morphAttributes.position||q.morphAttributes.normal||q.morphAttributes.color,sn=xe!==void 0?xe.length:0,Pt=Bt.get(z),qe=T.state.lights;if(Ue===!0&&(fn===!0||S!==k)){let Ce=S===k&&z.id===X;Q.setState(z,S,Ce)}let he=!1,_i=!1;z.version===Pt.__version?Pt.needsLights&&Pt.lightsStateVersion!==qe.state.version||V.isBatchedMesh&&Pt.batching===!1||!V.isBatchedMesh&&Pt.batching===!0||V.isBatchedMesh&&Pt.batchingColor===!0&&V._colorsTexture===null||V.isBatchedMesh&&Pt.batchingColor===!1&&V._colorsTexture!==null||V.isInstancedMesh&&Pt.instancing===!1||!V.isInstancedMesh&&Pt.instancing===!0||V.isSkinnedMesh&&Pt.skinning===!1||!V.isSkinnedMesh&&Pt.skinning===!0||V.isInstancedMesh&&Pt.instancingColor===!0&&V.instanceColor===null||V.isInstancedMesh&&Pt.instancingColor===!1&&V.instanceColor!==null||V.isInstancedMesh&&Pt.instancingMorph===!0&&V.morphTexture===null||V.isInstancedMesh&&Pt.instancingMorph===!1&&V.morphTexture!==null||Pt.envMap!==Lt||z.fog===!0&&Pt.fog!==gt||Pt.numClippingPlanes!==void 0&&(Pt.numClippingPlanes!==Q.numPlanes||Pt.numIntersection!==Q.numIntersection)||Pt.vertexAlphas!==Xt||Pt.vertexTangents!==ne||Pt.morphTargets!==Ct||Pt.morphNormals!==ie||Pt.morphColors!==Ie||Pt.morphTargetsCount!==sn||Pt.numLightProbeGrids!==ea(T.state.lightProbeGridArray)?he=!0:(Pt.outputColorSpace!==xt||Pt.toneMapping!==fe)&&(_i=!0):(he=!0,Pt.__version=z.version);let Ye=Pt.currentProgram;(he===!0||_i===!0)&&(Ye=_i===!0?xh(z,N,V,xt,fe):Ji(z,N,V),H&&z.isNodeMaterial&&H.onUpdateProgram(z,Ye,Pt));let Ms=!1,ai=!1,yi=!1,le=Ye.getUniforms(),He=Pt.uniforms;if(Mt.useProgram(Ye.program)&&(Ms=!0,ai=!0,yi=!0),z.id!==X&&(X=z.id,ai=!0),Ms||k!==S){Mt.buffers.depth.getReversed()&&S.reversedDepth!==!0&&(S._reversedDepth=!0,S.updateProjectionMatrix()),le.setValue(D,"projectionMatrix",S.projectionMatrix),le.setValue(D,"viewMatrix",S.matrixWorldInverse);let We=le.map.cameraPosition;We!==void 0&&We.setValue(D,oe.setFromMatrixPosition(S.matrixWorld)),Ae.logarithmicDepthBuffer&&le.setValue(D,"logDepthBufFC",2/(Math.log(S.far+1)/Math.LN2)),(z.isMeshPhongMaterial||z.isMeshToonMaterial||z.isMeshLambertMaterial||z.isMeshBasicMaterial||z.isMeshStandardMaterial||z.isShaderMaterial)&&le.setValue(D,"isOrthographic",S.isOrthographicCamera===!0),k!==S&&(k=S,ai=!0,yi=!0)}if(Pt.needsLights&&(qe.state.sunShadowMap.length>0&&le.setValue(D,"sunShadowMap",qe.state.sunShadowMap,Gt),qe.state.directionalShadowMap.length>0&&le.setValue(D,"directionalShadowMap",qe.state.directionalShadowMap,Gt),qe.state.spotShadowMap.length>0&&le.setValue(D,"spotShadowMap",qe.state.spotShadowMap,Gt),qe.state.pointShadowMap.length>0&&le.setValue(D,"pointShadowMap",qe.state.pointShadowMap,Gt)),V.isSkinnedMesh){le.setOptional(D,V,"bindMatrix"),le.setOptional(D,V,"bindMatrixInverse");let Ce=V.skeleton;Ce&&(Ce.boneTexture===null&&Ce.computeBoneTexture(),le.setValue(D,"boneTexture",Ce.boneTexture,Gt))}V.isBatchedMesh&&(le.setOptional(D,V,"batchingTexture"),le.setValue(D,"batchingTexture",V._matricesTexture,Gt),le.setOptional(D,V,"batchingIdTexture"),le.setValue(D,"batchingIdTexture",V._indirectTexture,Gt),le.setOptional(D,V,"batchingColorTexture"),V._colorsTexture!==null&&le.setValue(D,"batchingColorTexture",V._colorsTexture,Gt));let Bn=q.morphAttributes;if((Bn.position!==void 0||Bn.normal!==void 0||Bn.color!==void 0)&&nt.update(V,q,Ye),(ai||Pt.receiveShadow!==V.receiveShadow)&&(Pt.receiveShadow=V.receiveShadow,le.setValue(D,"receiveShadow",V.receiveShadow)),(z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial)&&z.envMap===null&&N.environment!==null&&(He.envMapIntensity.value=N.environmentIntensity),He.dfgLUT!==void 0&&(He.dfgLUT.value=rA()),ai){if(le.setValue(D,"toneMappingExposure",L.toneMappingExposure),Pt.needsLights&&vs(He,yi),gt&&z.fog===!0&&ut.refreshFogUniforms(He,gt),ut.refreshMaterialUniforms(He,z,lt,Nt,T.state.transmissionRenderTarget[S.id]),Pt.needsLights&&Pt.numLightProbeGrids>0){let Ce=b,We=0;for(let Yn of T.state.lightProbeGridArray)Yn.texture!==null&&(Ce.textures[We]=Yn.texture,Ce.min[We]=Yn.boundingBox.min,Ce.max[We]=Yn.boundingBox.max,Ce.resolution[We]=Yn.resolution,We++);for(let Yn in Ce)Ce[Yn].length=We;He.probesSH.value=Ce.textures,He.probesMin.value=Ce.min,He.probesMax.value=Ce.max,He.probesResolution.value=Ce.resolution}Jr.upload(D,Eo(Pt),He,Gt)}if(z.isShaderMaterial&&z.uniformsNeedUpdate===!0&&(Jr.upload(D,Eo(Pt),He,Gt),z.uniformsNeedUpdate=!1),z.isSpriteMaterial&&le.setValue(D,"center",V.center),le.setValue(D,"modelViewMatrix",V.modelViewMatrix),le.setValue(D,"normalMatrix",V.normalMatrix),le.setValue(D,"modelMatrix",V.matrixWorld),z.uniformsGroups!==void 0){let Ce=z.uniformsGroups;for(let We=0,Yn=Ce.length;We<Yn;We++){let To=Ce[We];Dt.update(To,Ye),Dt.bind(To,Ye)}}return Ye}function vs(S,N){S.ambientLightColor.needsUpdate=N,S.lightProbe.needsUpdate=N,S.sunLights.needsUpdate=N,S.sunLightShadows.needsUpdate=N,S.directionalLights.needsUpdate=N,S.directionalLightShadows.needsUpdate=N,S.pointLights.needsUpdate=N,S.pointLightShadows.needsUpdate=N,S.spotLights.needsUpdate=N,S.spotLightShadows.needsUpdate=N,S.rectAreaLights.needsUpdate=N,S.hemisphereLights.needsUpdate=N}function vh(S){return S.isMeshLambertMaterial||S.isMeshToonMaterial||S.isMeshPhongMaterial||S.isMeshStandardMaterial||S.isShadowMaterial||S.isShaderMaterial&&S.lights===!0}this.getActiveCubeFace=function(){return tt},this.getActiveMipmapLevel=function(){return $},this.getRenderTarget=function(){return at},this.setRenderTargetTextures=function(S,N,q){let z=Bt.get(S);z.__autoAllocateDepthBuffer=S.resolveDepthBuffer===!1,z.__autoAllocateDepthBuffer===!1&&(z.__useRenderToTexture=!1),Bt.get(S.texture).__webglTexture=N,Bt.get(S.depthTexture).__webglTexture=z.__autoAllocateDepthBuffer?void 0:q,z.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(S,N){let q=Bt.get(S);q.__webglFramebuffer=N,q.__useDefaultFramebuffer=N===void 0},this.setRenderTarget=function(S,N=0,q=0){at=S,tt=N,$=q;let z=null,V=!1,gt=!1;if(S){let xt=Bt.get(S);if(xt.__useDefaultFramebuffer!==void 0){Mt.bindFramebuffer(D.FRAMEBUFFER,xt.__webglFramebuffer),it.copy(S.viewport),Tt.copy(S.scissor),kt=S.scissorTest,Mt.viewport(it),Mt.scissor(Tt),Mt.setScissorTest(kt),X=-1;return}else if(xt.__webglFramebuffer===void 0)Gt.setupRenderTarget(S);else if(xt.__hasExternalTextures)Gt.rebindTextures(S,Bt.get(S.texture).__webglTexture,Bt.get(S.depthTexture).__webglTexture);else if(S.depthBuffer){let Xt=S.depthTexture;if(xt.__boundDepthTexture!==Xt){if(Xt!==null&&Bt.has(Xt)&&(S.width!==Xt.image.width||S.height!==Xt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Gt.setupDepthRenderbuffer(S)}}let wt=S.texture;(wt.isData3DTexture||wt.isDataArrayTexture||wt.isCompressedArrayTexture)&&(gt=!0);let Lt=Bt.get(S).__webglFramebuffer;S.isWebGLCubeRenderTarget?(Array.isArray(Lt[N])?z=Lt[N][q]:z=Lt[N],V=!0):S.samples>0&&Gt.useMultisampledRTT(S)===!1?z=Bt.get(S).__webglMultisampledFramebuffer:Array.isArray(Lt)?z=Lt[q]:z=Lt,it.copy(S.viewport),Tt.copy(S.scissor),kt=S.scissorTest}else it.copy(Ft).multiplyScalar(lt).floor(),Tt.copy(ee).multiplyScalar(lt).floor(),kt=_e;if(q!==0&&(z=Z),Mt.bindFramebuffer(D.FRAMEBUFFER,z)&&Mt.drawBuffers(S,z),Mt.viewport(it),Mt.scissor(Tt),Mt.setScissorTest(kt),V){let xt=Bt.get(S.texture);D.framebufferTexture2D(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_CUBE_MAP_POSITIVE_X+N,xt.__webglTexture,q)}else if(gt){let xt=N;for(let wt=0;wt<S.textures.length;wt++){let Lt=Bt.get(S.textures[wt]);D.framebufferTextureLayer(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0+wt,Lt.__webglTexture,q,xt)}}else if(S!==null&&q!==0){let xt=Bt.get(S.texture);D.framebufferTexture2D(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,xt.__webglTexture,q)}X=-1};function ia(S){let N=Bt.get(S);return(N.__readFormat!==S.format||N.__readType!==S.type)&&(N.__readFormat=S.format,N.__readType=S.type,N.__formatReadable=Ae.textureFormatReadable(S.format),N.__typeReadable=Ae.textureTypeReadable(S.type)),N}this.readRenderTargetPixels=function(S,N,q,z,V,gt,Rt,xt=0){if(!(S&&S.isWebGLRenderTarget)){Ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let wt=Bt.get(S).__webglFramebuffer;if(S.isWebGLCubeRenderTarget&&Rt!==void 0&&(wt=wt[Rt],Array.isArray(wt)&&(wt=wt[0])),wt){Mt.bindFramebuffer(D.FRAMEBUFFER,wt);try{let Lt=S.textures[xt],Xt=Lt.format,ne=Lt.type;S.textures.length>1&&D.readBuffer(D.COLOR_ATTACHMENT0+xt);let Ct=ia(Lt);if(Ct.__formatReadable===!1){Ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Ct.__typeReadable===!1){Ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}N>=0&&N<=S.width-z&&q>=0&&q<=S.height-V&&D.readPixels(N,q,z,V,ht.convert(Xt),ht.convert(ne),gt)}finally{let Lt=at!==null?Bt.get(at).__webglFramebuffer:null;Mt.bindFramebuffer(D.FRAMEBUFFER,Lt)}}},this.readRenderTargetPixelsAsync=async function(S,N,q,z,V,gt,Rt,xt=0){if(!(S&&S.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let wt=Bt.get(S).__webglFramebuffer;if(S.isWebGLCubeRenderTarget&&Rt!==void 0&&(wt=wt[Rt],Array.isArray(wt)&&(wt=wt[0])),wt)if(N>=0&&N<=S.width-z&&q>=0&&q<=S.height-V){Mt.bindFramebuffer(D.FRAMEBUFFER,wt);let Lt=S.textures[xt],Xt=Lt.format,ne=Lt.type;S.textures.length>1&&D.readBuffer(D.COLOR_ATTACHMENT0+xt);let Ct=ia(Lt);if(Ct.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Ct.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let ie=D.createBuffer();D.bindBuffer(D.PIXEL_PACK_BUFFER,ie),D.bufferData(D.PIXEL_PACK_BUFFER,gt.byteLength,D.STREAM_READ),D.readPixels(N,q,z,V,ht.convert(Xt),ht.convert(ne),0),D.bindBuffer(D.PIXEL_PACK_BUFFER,null);let Ie=at!==null?Bt.get(at).__webglFramebuffer:null;Mt.bindFramebuffer(D.FRAMEBUFFER,Ie);let fe=D.fenceSync(D.SYNC_GPU_COMMANDS_COMPLETE,0);return D.flush(),await B0(D,fe,4),D.bindBuffer(D.PIXEL_PACK_BUFFER,ie),D.getBufferSubData(D.PIXEL_PACK_BUFFER,0,gt),D.bindBuffer(D.PIXEL_PACK_BUFFER,null),D.deleteBuffer(ie),D.deleteSync(fe),gt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(S,N=null,q=0){let z=Math.pow(2,-q),V=Math.floor(S.image.width*z),gt=Math.floor(S.image.height*z),Rt=N!==null?N.x:0,xt=N!==null?N.y:0;Gt.setTexture2D(S,0),D.copyTexSubImage2D(D.TEXTURE_2D,q,0,0,Rt,xt,V,gt),Mt.unbindTexture()},this.copyTextureToTexture=function(S,N,q=null,z=null,V=0,gt=0){let Rt,xt,wt,Lt,Xt,ne,Ct,ie,Ie,fe=S.isCompressedTexture?S.mipmaps[gt]:S.image;if(q!==null)Rt=q.max.x-q.min.x,xt=q.max.y-q.min.y,wt=q.isBox3?q.max.z-q.min.z:1,Lt=q.min.x,Xt=q.min.y,ne=q.isBox3?q.min.z:0;else{let le=Math.pow(2,-V);Rt=Math.floor(fe.width*le),xt=Math.floor(fe.height*le),S.isDataArrayTexture?wt=fe.depth:S.isData3DTexture?wt=Math.floor(fe.depth*le):wt=1,Lt=0,Xt=0,ne=0}z!==null?(Ct=z.x,ie=z.y,Ie=z.z):(Ct=0,ie=0,Ie=0);let xe=ht.convert(N.format),sn=ht.convert(N.type),Pt;N.isData3DTexture?(Gt.setTexture3D(N,0),Pt=D.TEXTURE_3D):N.isDataArrayTexture||N.isCompressedArrayTexture?(Gt.setTexture2DArray(N,0),Pt=D.TEXTURE_2D_ARRAY):(Gt.setTexture2D(N,0),Pt=D.TEXTURE_2D),Mt.activeTexture(D.TEXTURE0),Mt.pixelStorei(D.UNPACK_FLIP_Y_WEBGL,N.flipY),Mt.pixelStorei(D.UNPACK_PREMULTIPLY_ALPHA_WEBGL,N.premultiplyAlpha),Mt.pixelStorei(D.UNPACK_ALIGNMENT,N.unpackAlignment);let qe=Mt.getParameter(D.UNPACK_ROW_LENGTH),he=Mt.getParameter(D.UNPACK_IMAGE_HEIGHT),_i=Mt.getParameter(D.UNPACK_SKIP_PIXELS),Ye=Mt.getParameter(D.UNPACK_SKIP_ROWS),Ms=Mt.getParameter(D.UNPACK_SKIP_IMAGES);Mt.pixelStorei(D.UNPACK_ROW_LENGTH,fe.width),Mt.pixelStorei(D.UNPACK_IMAGE_HEIGHT,fe.height),Mt.pixelStorei(D.UNPACK_SKIP_PIXELS,Lt),Mt.pixelStorei(D.UNPACK_SKIP_ROWS,Xt),Mt.pixelStorei(D.UNPACK_SKIP_IMAGES,ne);let ai=S.isDataArrayTexture||S.isData3DTexture,yi=N.isDataArrayTexture||N.isData3DTexture;if(S.isDepthTexture){let le=Bt.get(S),He=Bt.get(N),Bn=Bt.get(le.__renderTarget),Ce=Bt.get(He.__renderTarget);Mt.bindFramebuffer(D.READ_FRAMEBUFFER,Bn.__webglFramebuffer),Mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,Ce.__webglFramebuffer);for(let We=0;We<wt;We++)ai&&(D.framebufferTextureLayer(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Bt.get(S).__webglTexture,V,ne+We),D.framebufferTextureLayer(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Bt.get(N).__webglTexture,gt,Ie+We)),D.blitFramebuffer(Lt,Xt,Lt+Rt,Xt+xt,Ct,ie,Ct+Rt,ie+xt,D.DEPTH_BUFFER_BIT,D.NEAREST);Mt.bindFramebuffer(D.READ_FRAMEBUFFER,null),Mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,null)}else if(V!==0||S.isRenderTargetTexture||Bt.has(S)){let le=Bt.get(S),He=Bt.get(N);Mt.bindFramebuffer(D.READ_FRAMEBUFFER,P),Mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,W);for(let Bn=0;Bn<wt;Bn++)ai?D.framebufferTextureLayer(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,le.__webglTexture,V,ne+Bn):D.framebufferTexture2D(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,le.__webglTexture,V),yi?D.framebufferTextureLayer(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,He.__webglTexture,gt,Ie+Bn):D.framebufferTexture2D(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,He.__webglTexture,gt),V!==0?D.blitFramebuffer(Lt,Xt,Lt+Rt,Xt+xt,Ct,ie,Ct+Rt,ie+xt,D.COLOR_BUFFER_BIT,D.NEAREST):yi?D.copyTexSubImage3D(Pt,gt,Ct,ie,Ie+Bn,Lt,Xt,Rt,xt):D.copyTexSubImage2D(Pt,gt,Ct,ie,Lt,Xt,Rt,xt);Mt.bindFramebuffer(D.READ_FRAMEBUFFER,null),Mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,null)}else yi?S.isDataTexture||S.isData3DTexture?D.texSubImage3D(Pt,gt,Ct,ie,Ie,Rt,xt,wt,xe,sn,fe.data):N.isCompressedArrayTexture?D.compressedTexSubImage3D(Pt,gt,Ct,ie,Ie,Rt,xt,wt,xe,fe.data):D.texSubImage3D(Pt,gt,Ct,ie,Ie,Rt,xt,wt,xe,sn,fe):S.isDataTexture?D.texSubImage2D(D.TEXTURE_2D,gt,Ct,ie,Rt,xt,xe,sn,fe.data):S.isCompressedTexture?D.compressedTexSubImage2D(D.TEXTURE_2D,gt,Ct,ie,fe.width,fe.height,xe,fe.data):D.texSubImage2D(D.TEXTURE_2D,gt,Ct,ie,Rt,xt,xe,sn,fe);Mt.pixelStorei(D.UNPACK_ROW_LENGTH,qe),Mt.pixelStorei(D.UNPACK_IMAGE_HEIGHT,he),Mt.pixelStorei(D.UNPACK_SKIP_PIXELS,_i),Mt.pixelStorei(D.UNPACK_SKIP_ROWS,Ye),Mt.pixelStorei(D.UNPACK_SKIP_IMAGES,Ms),gt===0&&N.generateMipmaps===!0&&N.mipmapsAutoUpdate===!0&&D.generateMipmap(Pt),Mt.unbindTexture()},this.initRenderTarget=function(S){Bt.get(S).__webglFramebuffer===void 0&&Gt.setupRenderTarget(S)},this.initTexture=function(S){S.isCubeTexture?Gt.setTextureCube(S,0):S.isData3DTexture?Gt.setTexture3D(S,0):S.isDataArrayTexture||S.isCompressedArrayTexture?Gt.setTexture2DArray(S,0):Gt.setTexture2D(S,0),Mt.unbindTexture()},this.resetState=function(){tt=0,$=0,at=null,Mt.reset(),dt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return ii}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=ce._getDrawingBufferColorSpace(t),e.unpackColorSpace=ce._getUnpackColorSpace()}};var S_={type:"change"},wd={type:"start"},A_={type:"end"},ph=new Xi,E_=new Tn,aA=Math.cos(70*od.DEG2RAD),nn=new B,Fn=2*Math.PI,ge={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},bd=1e-6,mh=class extends co{constructor(t,e=null){super(t,e),this.state=ge.NONE,this.target=new B,this.cursor=new B,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:ms.ROTATE,MIDDLE:ms.DOLLY,RIGHT:ms.PAN},this.touches={ONE:gs.ROTATE,TWO:gs.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new B,this._lastQuaternion=new xn,this._lastTargetPosition=new B,this._quat=new xn().setFromUnitVectors(t.up,new B(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new ps,this._sphericalDelta=new ps,this._scale=1,this._panOffset=new B,this._rotateStart=new zt,this._rotateEnd=new zt,this._rotateDelta=new zt,this._panStart=new zt,this._panEnd=new zt,this._panDelta=new zt,this._dollyStart=new zt,this._dollyEnd=new zt,this._dollyDelta=new zt,this._dollyDirection=new B,this._mouse=new zt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=lA.bind(this),this._onPointerDown=oA.bind(this),this._onPointerUp=cA.bind(this),this._onContextMenu=gA.bind(this),this._onMouseWheel=fA.bind(this),this._onKeyDown=dA.bind(this),this._onTouchStart=pA.bind(this),this._onTouchMove=mA.bind(this),this._onMouseDown=hA.bind(this),this._onMouseMove=uA.bind(this),this._interceptControlDown=_A.bind(this),this._interceptControlUp=yA.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=ge.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(S_),this.update(),this.state=ge.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;nn.copy(e).sub(this.target),nn.applyQuaternion(this._quat),this._spherical.setFromVector3(nn),this.autoRotate&&this.state===ge.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=Fn:n>Math.PI&&(n-=Fn),s<-Math.PI?s+=Fn:s>Math.PI&&(s-=Fn),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let a=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=a!=this._spherical.radius}if(nn.setFromSpherical(this._spherical),nn.applyQuaternion(this._quatInverse),e.copy(this.target).add(nn),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let a=null;if(this.object.isPerspectiveCamera){let o=nn.length();a=this._clampDistance(o*this._scale);let l=o-a;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let o=new B(this._mouse.x,this._mouse.y,0);o.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new B(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(o),this.object.updateMatrixWorld(),a=nn.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;a!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(a).add(this.object.position):(ph.origin.copy(this.object.position),ph.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(ph.direction))<aA?this.object.lookAt(this.target):(E_.setFromNormalAndCoplanarPoint(this.object.up,this.target),ph.intersectPlane(E_,this.target))))}else if(this.object.isOrthographicCamera){let a=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),a!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>bd||8*(1-this._lastQuaternion.dot(this.object.quaternion))>bd||this._lastTargetPosition.distanceToSquared(this.target)>bd?(this.dispatchEvent(S_),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?Fn/60*this.autoRotateSpeed*t:Fn/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){nn.setFromMatrixColumn(e,0),nn.multiplyScalar(-t),this._panOffset.add(nn)}_panUp(t,e){this.screenSpacePanning===!0?nn.setFromMatrixColumn(e,1):(nn.setFromMatrixColumn(e,0),nn.crossVectors(this.object.up,nn)),nn.multiplyScalar(t),this._panOffset.add(nn)}_pan(t,e){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;nn.copy(s).sub(this.target);let r=nn.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,a=n.width,o=n.height;this._mouse.x=s/a*2-1,this._mouse.y=-(r/o)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(Fn*this._rotateDelta.x/e.clientHeight),this._rotateUp(Fn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(Fn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-Fn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(Fn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-Fn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(Fn*this._rotateDelta.x/e.clientHeight),this._rotateUp(Fn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let a=(t.pageX+e.x)*.5,o=(t.pageY+e.y)*.5;this._updateZoomParameters(a,o)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new zt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function oA(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function lA(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function cA(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(A_),this.state=ge.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function hA(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case ms.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=ge.DOLLY;break;case ms.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=ge.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=ge.ROTATE}break;case ms.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=ge.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=ge.PAN}break;default:this.state=ge.NONE}this.state!==ge.NONE&&this.dispatchEvent(wd)}function uA(i){switch(this.state){case ge.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case ge.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case ge.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function fA(i){this.enabled===!1||this.enableZoom===!1||this.state!==ge.NONE||(i.preventDefault(),this.dispatchEvent(wd),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(A_))}function dA(i){this.enabled!==!1&&this._handleKeyDown(i)}function pA(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case gs.ROTATE:if(this.enableRotate===!1){this.state=ge.NONE;break}this._handleTouchStartRotate(i),this.state=ge.TOUCH_ROTATE;break;case gs.PAN:if(this.enablePan===!1){this.state=ge.NONE;break}this._handleTouchStartPan(i),this.state=ge.TOUCH_PAN;break;default:this.state=ge.NONE}break;case 2:switch(this.touches.TWO){case gs.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=ge.TOUCH_DOLLY_PAN;break;case gs.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=ge.TOUCH_DOLLY_ROTATE;break;default:this.state=ge.NONE}break;default:this.state=ge.NONE}this.state!==ge.NONE&&this.dispatchEvent(wd)}function mA(i){switch(this._trackPointer(i),this.state){case ge.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case ge.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case ge.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case ge.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=ge.NONE}}function gA(i){this.enabled!==!1&&i.preventDefault()}function _A(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function yA(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var T_=1.7,Sd=22,gh=class{constructor(t,e){this.canvas=t,this.body=e;let n=t.getContext("webgl2",{antialias:!0,alpha:!1});if(!n)throw new Error("no WebGL");this.renderer=new uh({canvas:t,context:n}),this.renderer.shadowMap.enabled=!0,this.renderer.shadowMap.type=Vs,this.renderer.outputColorSpace=yn,this.scene=new Ha,this.scene.background=new Jt,this.scene.fog=new Va(0,9,34),this.camera=new Rn(38,1,.05,200),this.controls=new mh(this.camera,t),Object.assign(this.controls,{enableDamping:!0,dampingFactor:.12,maxPolarAngle:1.53,minDistance:1,maxDistance:30}),this.controls.addEventListener("change",()=>{this.stale=!0}),this.bodies=[],this.shared=vA(e),this.addRoom(),this.paint(),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>this.paint()),t.addEventListener("webglcontextrestored",()=>{this.stale=!0}),this.resetView(),this.time=0}addRoom(){this.scene.add(new io(16777215,12897238,1.9),new oo(16777215,.35)),this.sun=new ao(16777215,1.7),this.sun.castShadow=!0,this.sun.shadow.mapSize.set(1024,1024),Object.assign(this.sun.shadow.camera,{left:-6,right:6,top:6,bottom:-6,near:.5,far:20}),this.sun.shadow.radius=4,this.scene.add(this.sun,this.sun.target);let t=new On(new Gs(200,200),new to({color:1844272,opacity:.22}));t.rotation.x=-Math.PI/2,t.receiveShadow=!0,this.grid=xA(30),this.scene.add(t,this.grid),this.line=new Vr(new Pn,new zs({color:13649212})),this.line.frustumCulled=!1,this.scene.add(this.line),this.ring=new On(new Qa(.34,.4,48),new zr({color:3108816,transparent:!0,opacity:.8})),this.ring.rotation.x=-Math.PI/2,this.ring.position.y=.006,this.ring.visible=!1,this.scene.add(this.ring)}paint(){let t=getComputedStyle(this.canvas),e=n=>t.getPropertyValue(n).trim();this.scene.fog.color.copy(this.scene.background.set(e("--room"))),this.grid.material.color.set(e("--grid")),this.stale=!0}show(t,e){for(;this.bodies.length>t.length;)this.scene.remove(this.bodies.pop().mesh);for(;this.bodies.length<t.length;)this.bodies.push(this.newBody());this.motions=t,this.chosen=e,this.offsets=t.map((n,s)=>(s-(t.length-1)/2)*T_),this.placeAt(this.time)}newBody(){let{geometry:t,parents:e,offsets:n,colours:s}=this.shared,r=e.map((l,c)=>{let h=new Gr;return h.position.fromArray(n[c]),h});e.forEach((l,c)=>{l>=0&&r[l].add(r[c])});let a=new $a(t,new eo({vertexColors:!0}));a.castShadow=!0,a.frustumCulled=!1,a.add(r[0]);let o=this.body.skeleton.rest.map(([l,c,h])=>new re().makeTranslation(-l,-c,-h));return a.bind(new Ya(r,o),new re),this.scene.add(a),{mesh:a,bones:r,colours:s}}placeAt(t){this.time=t;let e=new xn,n=new xn;this.bodies.forEach(({mesh:s,bones:r},a)=>{let{frames:o,fps:l,quaternions:c,root:h}=this.motions[a],u=Math.min(Math.max(t*l,0),o-1),f=Math.floor(u),d=Math.min(f+1,o-1),m=u-f;for(let y=0;y<Sd;y++){let[w,b]=[(f*Sd+y)*4,(d*Sd+y)*4];e.set(c[w+1],c[w+2],c[w+3],c[w]),n.set(c[b+1],c[b+2],c[b+3],c[b]),r[y].quaternion.slerpQuaternions(e,n,m)}let[_,p,g]=[0,1,2].map(y=>h[f*3+y]+m*(h[d*3+y]-h[f*3+y]));r[0].position.set(_,p,g),s.position.x=this.offsets[a],a===this.chosen&&(this.ring.position.set(_+this.offsets[a],.006,g),this.focus=new B(_+this.offsets[a],0,g))}),this.ring.visible=this.bodies.length>1,this.stale=!0}showPath(t){let e=(t??[]).map(([n,s])=>new B(n+(this.offsets?.[this.chosen]??0),.01,s));this.line.geometry.dispose(),this.line.geometry=new Pn().setFromPoints(e),this.line.visible=e.length>1,this.stale=!0}floorAt(t){let e=this.canvas.getBoundingClientRect(),n=new zt((t.clientX-e.left)/e.width*2-1,1-(t.clientY-e.top)/e.height*2);this.camera.updateMatrixWorld();let s=new lo;s.setFromCamera(n,this.camera);let r=s.ray.intersectPlane(new Tn(new B(0,1,0)),new B);return r&&r.length()<60?[r.x-(this.offsets?.[this.chosen]??0),r.z]:null}takeAt(t){let e=this.canvas.getBoundingClientRect(),n=null,s=.07*e.width;return this.bodies.forEach(({bones:r},a)=>{let o=r[9].getWorldPosition(new B).project(this.camera),l=Math.hypot((o.x+1)/2*e.width+e.left-t.clientX,(1-o.y)/2*e.height+e.top-t.clientY);l<s&&(s=l,n=a)}),n}resetView(t=!1){let e=Math.max(0,(this.bodies?.length??1)-1),n=this.focus?this.focus.clone().setY(.85):new B(0,.85,0);if(this.bodies?.length>1&&(n.x=0),this.controls.target.copy(n),t)this.camera.position.set(n.x,11,n.z-3);else{let s=e*T_/2+.9,r=s/(Math.tan(this.camera.fov*Math.PI/360)*this.camera.aspect);this.camera.position.copy(n).add(new B(1.6/(1+e),.9,3.7).setLength(Math.max(4.1,r)))}this.controls.update(),this.stale=!0}turn(t,e,n=1){let{target:s}=this.controls,r=new ps().setFromVector3(this.camera.position.clone().sub(s));r.set(r.radius*n,r.phi-e,r.theta+t).makeSafe(),this.camera.position.setFromSpherical(r).add(s)}draw(t,e){if(t&&this.focus){let r=this.focus.clone();this.bodies.length>1&&(r.x=this.controls.target.x);let a=r.setY(this.controls.target.y).sub(this.controls.target).multiplyScalar(1-Math.exp(-4*e));this.controls.target.add(a),this.camera.position.add(a)}if(this.controls.update(),!this.stale)return;this.stale=!1;let{x:n,z:s}=this.controls.target;this.sun.target.position.set(n,0,s),this.sun.position.set(n+2.5,6,s+3),this.renderer.render(this.scene,this.camera),this.keepPace(e)}keepPace(t){this.late=t>.045?(this.late??0)+1:0,!(this.late<12||this.lean===2)&&(this.late=0,this.lean=(this.lean??0)+1,this.sun.castShadow=!1,this.resize())}resize(){let{clientWidth:t,clientHeight:e}=this.canvas.parentElement;!t||!e||(this.renderer.setPixelRatio(Math.min(window.devicePixelRatio,this.lean===2?.6:this.lean?1:2)),this.renderer.setSize(t,e,!1),this.camera.aspect=t/e,this.camera.updateProjectionMatrix(),this.stale=!0)}};function xA(i){let t=[];for(let s=-i;s<=i;s++)for(let r=-i;r<i;r++)t.push(s,0,r,s,0,r+1,r,0,s,r+1,0,s);let e=new Pn().setAttribute("position",new cn(new Float32Array(t),3)),n=new Za(e,new zs);return n.position.y=.002,n}function vA({skeleton:i,mesh:t,colours:e}){let n=(m,_)=>{let p=atob(m);return new _(Uint8Array.from(p,g=>g.charCodeAt(0)).buffer)},s=Float32Array.from(n(t.positions,Int16Array),m=>m*1e-4),r=Float32Array.from(n(t.normals,Int8Array),m=>m/127),a=n(t.joints,Uint8Array),o=n(t.weights,Uint8Array),l=new Float32Array(s.length),c=new Jt,[h,u,f]=["left","right","centre"].map(m=>new Jt().setRGB(...e[m],yn));for(let m=0;m<s.length/3;m++){let _=0;for(let p=0;p<4;p++)_+=o[m*4+p]/255*i.sides[a[m*4+p]];c.copy(f).lerp(_>0?h:u,Math.abs(_)).toArray(l,m*3)}let d=new Pn;return d.setAttribute("position",new cn(s,3)),d.setAttribute("normal",new cn(r,3)),d.setAttribute("color",new cn(l,3)),d.setAttribute("skinIndex",new cn(Uint16Array.from(a),4)),d.setAttribute("skinWeight",new cn(Float32Array.from(o,m=>m/255),4)),d.setIndex(new cn(n(t.triangles,Uint16Array),1)),{geometry:d,parents:i.parents,offsets:i.offsets,colours:e}}var MA=.5,_h=class{constructor(t,e){this.root=t,this.page=e,this.list=document.createElement("ol"),this.head=document.createElement("div"),this.head.className="playhead",t.append(this.list,this.head),new ResizeObserver(()=>this.fit()).observe(t)}show(){let{blocks:t}=this.page.scene,{selected:e}=this.page,n=[...this.list.children].findIndex(s=>s.contains(document.activeElement));this.list.replaceChildren(...t.map((s,r)=>this.item(s,r,e))),n>=0&&this.focus(Math.min(n,t.length-1)),this.fit(),e!==this.selected&&this.reveal(this.list.children[e]),this.selected=e}fit(){this.root.classList.toggle("long",this.list.scrollWidth>this.root.clientWidth)}reveal({offsetLeft:t,offsetWidth:e}){this.root.scrollLeft=Math.min(Math.max(this.root.scrollLeft,t+e-this.root.clientWidth),t)}focus(t){this.list.children[t].querySelector("button").focus()}move(t,e){this.page.moveBlock(t,e),this.focus(e)}item({text:t,seconds:e},n,s){let r=document.createElement("li"),a=document.createElement("button"),o=document.createElement("span");r.style.flexGrow=e,r.classList.toggle("selected",n===s),a.type="button",a.textContent=t||"…",a.title="Drag to move; arrow keys select, Alt moves, Shift stretches, Delete removes",a.setAttribute("aria-label",`Sentence ${n+1}: ${t||"empty"}, ${e} seconds`),a.setAttribute("aria-current",String(n===s));let l=document.createElement("small");return l.textContent=`${e} s`,o.className="handle",r.append(a,l,o),a.addEventListener("click",()=>this.page.select(n)),a.addEventListener("keydown",c=>this.key(c,n)),a.addEventListener("pointerdown",c=>this.drag(c,n,a)),o.addEventListener("pointerdown",c=>this.stretch(c,n)),r}key(t,e){let n={ArrowLeft:-1,ArrowRight:1}[t.key],{blocks:s}=this.page.scene,r=e+n;if(n&&t.shiftKey)this.page.stretchBlock(e,s[e].seconds+n*MA,`stretch${e}`);else if(n&&s[r]&&t.altKey)this.move(e,r);else if(n&&s[r])this.page.select(r),this.focus(r);else if(t.key==="Delete")this.page.removeBlock(e);else if(!n)return;t.preventDefault()}drag(t,e,n){if(t.button||!t.isPrimary)return;let s=t.clientX,r=!1,l=R_(t,({clientX:c})=>{r||=Math.abs(c-s)>6,r&&(n.parentElement.classList.add("dragged"),n.parentElement.style.transform=`translateX(${c-s}px)`)},({clientX:c})=>{if(l(),!r)return;let u=[...this.list.children].map((f,d)=>{let m=f.getBoundingClientRect();return d===e?null:(m.left+m.right)/2}).filter(f=>f!==null&&f<c).length;u===e?this.show():this.move(e,u)},()=>this.show())}stretch(t,e){if(t.button||!t.isPrimary)return;t.preventDefault();let n=t.clientX,{seconds:s}=this.page.scene.blocks[e],r=Ta(this.page.scene.blocks)/this.list.scrollWidth,a=()=>{o(),this.page.history.rest()},o=R_(t,({clientX:l})=>{let c=Math.min(Math.max(s+(l-n)*r,Qe.seconds[0]),Qe.seconds[1]);this.page.stretchBlock(e,c,`stretch${e}`)},a,a)}at(t){let{blocks:e}=this.page.scene,n=0;for(;n<e.length-1&&t>=e[n].seconds;n++)t-=e[n].seconds;return[n,t]}showPlayhead(t){let[e,n]=this.at(t),{offsetLeft:s,offsetWidth:r}=this.list.children[e],a=s+n/this.page.scene.blocks[e].seconds*r;this.head.style.left=`${100*a/this.list.clientWidth}%`}};function R_({pointerId:i},t,e,n){let s=new AbortController,r=()=>s.abort(),a=(o,l)=>addEventListener(o,c=>{c.pointerId===i&&l(c)},{signal:s.signal});return a("pointermove",t),a("pointerup",e),a("pointercancel",()=>{r(),n()}),r}var rt=i=>document.getElementById(i),bA=24,wA=1.1,yh=.1,C_="Changed: Enter or Make makes it.";function L_(){globalThis.studio=new Ed,globalThis.studio.open().catch(i=>{rt("status").textContent=`The studio could not start: ${i.message}`,document.body.classList.add("failed")})}var Ed=class{async open(){this.settings=JSON.parse(rt("settings").textContent),Ho(this.settings.skeleton),this.motions=new Map,this.clips=new Map,this.clipBefore=null,this.selected=0,this.time=0,this.history=new yl(ju(location.hash)??yg,()=>this.changed());let t=rt("script").textContent,e=mg(document),n=this.scene.blocks.map(({text:l})=>l),s=_l.open(t,this.settings,e,n);this.openStage(),this.timeline=new _h(rt("timeline"),this),this.bind(),this.changed(),this.tell("Loading the model …"),this.timings={page:performance.now()},this.client=await s;let{glb:r,vrma:a,licences:o}=await e;Object.assign(this,{rest:{glb:r,vrma:a},licences:o}),this.timings.loaded=performance.now(),document.body.classList.add("ready"),rt("make").disabled=!1,await this.warn(),await this.make()}get scene(){return this.history.now}get clip(){return this.clips.get(this.scene.clip)??null}openStage(){try{this.stage=new gh(rt("stage"),this.settings.body)}catch{rt("no-stage").hidden=!1;return}rt("stage").tabIndex=0,new ResizeObserver(()=>this.stage.resize()).observe(rt("stage").parentElement),this.stage.resize();let t=performance.now(),e=n=>{let s=(n-t)/1e3;t=n,this.shown&&this.playing&&this.seek((this.time+Math.min(s,.25))%(this.seconds+.5)),this.stage.draw(rt("follow").checked&&!this.drawing,s),requestAnimationFrame(e)};requestAnimationFrame(e)}bind(){let t=rt("text");t.addEventListener("input",()=>{let e=t.value.length>Qe.text;this.editBlock({text:t.value},"text"),e&&this.tell(`A sentence has ${Qe.text} letters at most; what is beyond is cut off.`,"warning")}),t.addEventListener("blur",()=>this.history.rest()),t.addEventListener("keydown",e=>{e.key==="Enter"&&!e.shiftKey&&!e.isComposing&&(e.preventDefault(),this.make())}),rt("seconds").addEventListener("change",()=>this.editBlock({seconds:Ds(rt("seconds").valueAsNumber,Qe.seconds,this.scene.blocks[this.selected].seconds)})),rt("seed").addEventListener("change",()=>this.history.change({seed:Ds(rt("seed").valueAsNumber,[0,Qe.seed],this.scene.seed)})),rt("takes").addEventListener("change",()=>this.history.change({takes:rt("takes").value,chosen:0})),rt("dice").addEventListener("click",()=>{this.history.change({seed:Math.floor(Math.random()*1e5)}),this.make()}),rt("make").addEventListener("click",()=>this.make()),rt("stop").addEventListener("click",()=>this.stop()),rt("add").addEventListener("click",()=>this.addBlock()),rt("cut").addEventListener("click",()=>this.cutBlock()),rt("earlier").addEventListener("click",()=>this.moveBlock(this.selected,this.selected-1)),rt("later").addEventListener("click",()=>this.moveBlock(this.selected,this.selected+1)),rt("remove").addEventListener("click",()=>this.removeBlock()),rt("undo").addEventListener("click",()=>this.history.undo()),rt("redo").addEventListener("click",()=>this.history.redo()),rt("play").addEventListener("click",()=>this.setPlaying(!this.playing)),rt("scrub").addEventListener("input",()=>{this.setPlaying(!1),this.seek(rt("scrub").valueAsNumber)}),rt("view").addEventListener("click",()=>this.stage?.resetView()),rt("link").addEventListener("click",()=>this.copyLink());for(let e of["bvh","glb","vrma"])rt(`save-${e}`).addEventListener("click",()=>this.save(e));rt("save-film").addEventListener("click",()=>this.film());for(let[e,n]of Object.entries(Aa))rt("path").add(new Option(n.label,e));rt("path").querySelector("[value=draw]").disabled=!this.stage,rt("path").querySelector("[value=clip]").hidden=!0,rt("path").addEventListener("change",()=>this.choosePath(rt("path").value));for(let{language:e,prompt:n}of _g(this.settings.languages))rt("examples").add(new Option(`${e}: ${n}`,n));rt("examples").addEventListener("change",()=>{rt("examples").value&&(this.editBlock({text:rt("examples").value}),this.make()),rt("examples").value=""}),addEventListener("keydown",e=>this.key(e)),addEventListener("hashchange",()=>{let e=ju(location.hash);e?(this.history.change(e),this.make()):this.changed()}),this.bindStage(),this.bindClips(),rt("licences").addEventListener("click",()=>{rt("notices").querySelector("pre").textContent=this.licences?new TextDecoder().decode(this.licences):"",rt("notices").showModal()}),rt("about").textContent=`Model ${this.settings.name}: ${this.settings.licence}.`}key(t){let e=s=>t.target.closest?.(s),n=(t.ctrlKey||t.metaKey)&&!e("textarea, input[type=number]")&&t.key.toLowerCase();n==="y"||n==="z"&&t.shiftKey?(t.preventDefault(),this.history.redo()):n==="z"?(t.preventDefault(),this.history.undo()):t.key===" "&&!e("input, textarea, select, button, summary, dialog")?(t.preventDefault(),this.setPlaying(!this.playing)):t.key==="Escape"&&!t.isComposing&&!e("dialog")&&this.stop()}editBlock(t,e=null){let n=this.scene.blocks.map((s,r)=>r===this.selected?{...s,...t}:s);this.history.change({blocks:n},e&&`${e}${this.selected}`)}stretchBlock(t,e,n=null){this.history.change({blocks:this.scene.blocks.map((s,r)=>r===t?{...s,seconds:e}:s)},n)}addBlock(){if(this.scene.blocks.length>=Qe.blocks)return;let t=[...this.scene.blocks];t.splice(this.selected+1,0,{text:"",seconds:3}),this.selected++,this.history.change({blocks:t}),rt("text").focus()}cutBlock(){let t=[...this.scene.blocks],[e,n]=this.timeline.at(this.place),{text:s,seconds:r}=t[e],a=Math.round(n*10)/10,o=Math.round((r-a)*10)/10;if(Math.min(a,o)<Qe.seconds[0]){this.tell(`Move the playhead to where a sentence is to be cut; each part takes ${Qe.seconds[0]} seconds or more.`,"warning");return}t.splice(e,1,{text:s,seconds:a},{text:s,seconds:o}),this.selected=e+1,this.history.change({blocks:t})}moveBlock(t,e){if(e<0||e>=this.scene.blocks.length||t===e)return;let n=[...this.scene.blocks],[s]=n.splice(t,1);n.splice(e,0,s),this.selected=e,this.history.change({blocks:n})}removeBlock(t=this.selected){this.scene.blocks.length<2||(t<this.selected&&this.selected--,this.history.change({blocks:this.scene.blocks.filter((e,n)=>n!==t)}))}select(t){this.selected=t,this.history.rest(),this.changed()}changed(){let{blocks:t,seed:e,takes:n,chosen:s,path:r}=this.scene;this.selected=Math.min(this.selected,t.length-1);let a=t[this.selected];rt("text").value!==a.text&&(rt("text").value=a.text),rt("which").textContent=t.length>1?`Sentence ${this.selected+1} of ${t.length}`:"Sentence",rt("seconds").value=a.seconds,rt("seed").value=e,rt("takes").value=n,rt("remove").disabled=t.length<2,rt("earlier").disabled=this.selected===0,rt("later").disabled=this.selected===t.length-1,rt("undo").disabled=!this.history.past.length,rt("redo").disabled=!this.history.future.length;let o=r?Object.keys(Aa).find(l=>JSON.stringify(Aa[l].points)===JSON.stringify(r))??"drawn":"none";rt("path").querySelector("[value=drawn]").disabled=o!=="drawn",rt("path").disabled=!!this.clip,this.drawing||(rt("path").value=this.clip?"clip":o),this.timeline?.show(),clearTimeout(this.linkTimer),this.linkTimer=setTimeout(()=>history.replaceState(null,"",this.link()),300),this.clip!==this.clipBefore&&(this.clip&&this.putOnStage([this.clip.motion],0),this.tell(this.clip?`${this.clip.name}: ${(this.clip.motion.frames/Et).toFixed(2)} seconds. Choose what is to be done with it, then make.`:"The clip is closed."),this.clipBefore=this.clip,this.showClip()),this.showMotions(s),this.stage?.showPath(this.clip?null:r),this.warnSoon()}get asked(){let{blocks:t,path:e,seed:n,takes:s}=this.scene;return{blocks:t,path:e,seed:n,takes:s,clip:this.clip?this.clipChoice():null}}keyOf(t,{blocks:e,path:n,clip:s,seed:r}=this.asked){return JSON.stringify([e,n,s&&{...s,motion:null},r+t])}async make(){if(!this.client)return;if(this.making){this.again=!0;return}let{asked:t}=this,{takes:e,seed:n,...s}=t,r=s.blocks.findIndex(({text:c})=>!/[\p{L}\p{N}]/u.test(c));if(r>=0&&!s.clip){this.select(r),this.tell("Say in a few words what the body does.","warning"),rt("text").focus();return}let{mode:a,keep:o}=s.clip??{},l={continue:[o,0],between:[o,o]}[a]??[0,0];await this.during(async()=>{let c=0;this.tell(e>1?`Making ${e} takes …`:"Making the motion …");for(let p=0;p<e;p++){let g=this.keyOf(p,t),y=e>1?`take ${p+1} …`:"",w=this.motions.get(g);if(this.motions.delete(g),w){this.motions.set(g,w);continue}rt("progress").textContent=y;let b=performance.now(),E=await this.client.call("make",{scene:s,seed:n+p},T=>{rt("progress").textContent=`${y} ${(T/Et).toFixed(1)} s`});this.timings.motion=performance.now()-b,this.motions.set(g,{...E,kept:l,took:this.timings.motion}),this.motions.size>bA&&this.motions.delete(this.motions.keys().next().value),c++,this.showMotions(),this.timings.first??=performance.now()}let h=Array.from({length:e},(p,g)=>this.motions.get(this.keyOf(g,t))),u=P_(h),f=s.clip?"With the clip":"By its words",d=Math.abs(u-Ta(s.blocks))>.1?` ${f} it lasts ${u.toFixed(1)} s.`:"",m=(h.reduce((p,g)=>p+g.took,0)/1e3).toFixed(1),_=e>1?" Click a take to choose it.":"";this.tell(`${c?"Made":"Nothing has changed since it was made"} in ${m} s.${d}${_}`),await this.warn(),this.keyOf(0)!==this.keyOf(0,t)&&this.tell(C_)},()=>this.client.stop())}async during(t,e=()=>{}){this.halt=e,this.stopped=!1,this.setMaking(!0);try{await t()}catch(n){this.stopped?this.tell("Stopped; takes that are finished stay."):this.tell(n.message,"error")}await this.client?.opened,this.setMaking(!1),this.again&&(this.again=!1,this.make())}setMaking(t){this.making=t,document.body.classList.toggle("making",t),rt("make").setAttribute("aria-busy",String(t)),this.offerStop(),this.showButtons()}offerStop(){let t=this.drawing||this.making&&!this.stopped;!t&&document.activeElement===rt("stop")&&rt("make").focus({preventScroll:!0}),rt("stop").hidden=!t}stop(){if(this.drawing){this.stopDrawing(),this.tell("Nothing is drawn.");return}!this.making||this.stopped||(this.stopped=!0,this.again=!1,this.offerStop(),this.halt())}showMotions(){let{takes:t,chosen:e}=this.scene,n=Array.from({length:t},(a,o)=>this.motions.get(this.keyOf(o))),s=n.slice(0,n.includes(void 0)?n.indexOf(void 0):t),r=!!this.shown&&!s.length&&this.shown[0]!==this.clip?.motion;document.body.classList.toggle("stale",r),r&&!this.making&&!this.drawing&&this.tell(C_),s.length&&this.putOnStage(s,Math.min(e,s.length-1)),this.seek(this.time>this.seconds?0:this.time),this.showTakes(s.length),this.showButtons()}putOnStage(t,e){let n=this.shown;this.shown=t,this.choice=e,this.stage?.show(t,e),this.stage?.showPath(this.clip?null:this.scene.path),rt("stage").setAttribute("aria-label",`${t.length>1?`${t.length} bodies; take ${e+1} is chosen`:"A body"}: ${t[e].text||this.clip?.name}`),n||this.setPlaying(!matchMedia("(prefers-reduced-motion: reduce)").matches),n?.length!==t.length&&this.stage?.resetView(),rt("scrub").max=this.seconds}showButtons(){for(let t of["save-bvh","save-glb","save-vrma","use-motion"])rt(t).disabled=!this.shown;rt("play").disabled=!this.shown||!this.stage,rt("save-film").disabled=rt("play").disabled||this.making}showTakes(t){let{takes:e,chosen:n}=this.scene,s=rt("take-list"),r=e>1?e:0;for(;s.children.length>r;)s.lastElementChild.remove();for(let a=s.children.length;a<r;a++){let o=document.createElement("label"),l=document.createElement("input");Object.assign(l,{type:"radio",name:"take",value:a}),l.addEventListener("change",()=>this.choose(a)),o.append(l,`Take ${a+1}`),s.append(o)}for(let[a,o]of s.querySelectorAll("input").entries())Object.assign(o,{checked:a===n,disabled:a>=t})}choose(t){t<(this.shown?.length??0)&&this.history.change({chosen:t},"chosen")}setPlaying(t){this.playing=t&&!!(this.shown&&this.stage),rt("play").textContent=this.playing?"Pause":"Play"}seek(t){this.time=t,this.stage?.placeAt(t);let{seconds:e}=this,n=Math.min(t,e);rt("scrub").value=n,rt("scrub").setAttribute("aria-valuetext",`${n.toFixed(1)} seconds`),rt("clock").textContent=`${n.toFixed(2)} / ${e.toFixed(2)} s`,this.timeline?.showPlayhead(this.place)}get seconds(){return P_(this.shown??[])}get place(){let{kept:[t,e]=[0,0]}=this.shown?.[this.choice]??{},n=(this.time-t)/Math.max(this.seconds-t-e,.1);return Math.min(Math.max(n,0),1)*Ta(this.scene.blocks)}tell(t,e="note"){rt("status").textContent=t,rt("status").className=e,rt("progress").textContent=""}warnSoon(){clearTimeout(this.warnTimer),this.warnTimer=setTimeout(()=>this.warn().catch(()=>{}),400)}async warn(){if(!this.client)return;let t=[...new Set(this.scene.blocks.map(({text:a})=>a).filter(a=>a.trim()))],e=await Promise.all(t.map(a=>this.client.call("warning",{text:a}))),n=rt("warnings"),s=Array.from({length:this.scene.takes},(a,o)=>this.motions.get(this.keyOf(o))?.missed),r=[...new Set([...e,...s].filter(Boolean))];JSON.stringify(r)!==n.dataset.lines&&(n.dataset.lines=JSON.stringify(r),n.replaceChildren(...r.map(a=>{let o=document.createElement("li");return o.textContent=a,o})))}bindStage(){let t=rt("stage"),e=null;t.addEventListener("pointerdown",n=>{if(!n.isPrimary||(e=n,!this.drawing))return;t.setPointerCapture(n.pointerId);let s=this.stage.floorAt(n);this.line=s?[s]:[]}),t.addEventListener("pointermove",n=>{if(!this.drawing||!this.line?.length||n.pointerId!==e?.pointerId)return;let s=this.stage.floorAt(n),r=this.line[this.line.length-1];s&&Math.hypot(s[0]-r[0],s[1]-r[1])>.12&&(this.line.push(s),this.stage.showPath(this.line))}),t.addEventListener("pointercancel",n=>{n.pointerId===e?.pointerId&&(e=this.line=null,this.stage?.showPath(this.clip?null:this.scene.path))}),t.addEventListener("pointerup",n=>{if(n.pointerId===e?.pointerId){if(this.drawing&&this.line?.length){let s=this.line;this.stopDrawing(),s.length>2?this.takePath(s):this.tell("Draw a longer line on the floor.","warning")}else if(Math.hypot(n.clientX-e.clientX,n.clientY-e.clientY)<5){let s=this.stage?.takeAt(n);s!=null&&this.choose(s)}e=null}}),t.addEventListener("keydown",n=>{let s={ArrowLeft:[-yh,0],ArrowRight:[yh,0],ArrowUp:[0,yh],ArrowDown:[0,-yh],"+":[0,0,.9],"-":[0,0,1.1111111111111112]}[n.key];!s||this.drawing||n.ctrlKey||n.metaKey||n.altKey||(n.preventDefault(),this.stage?.turn(...s))})}choosePath(t){if(t==="draw"){this.playsAfter=this.playing,this.drawing=!0,this.setPlaying(!1),this.stage.controls.enabled=!1,this.stage.resetView(!0),document.body.classList.add("drawing"),this.tell("Draw the way on the floor with one stroke."),this.offerStop(),rt("stage").scrollIntoView({block:"nearest"});return}this.stopDrawing(),t!=="drawn"&&this.takePath(Aa[t].points)}takePath(t){let{blocks:e}=this.scene;if(t&&e.length===1){let n=Math.ceil(pr(t)/wA+1);this.history.change({path:t,blocks:[{...e[0],seconds:n}]})}else this.history.change({path:t});this.make()}stopDrawing(){this.drawing&&(this.drawing=!1,this.line=null,this.stage.controls.enabled=!0,this.stage.resetView(),this.stage.showPath(this.scene.path),document.body.classList.remove("drawing"),this.offerStop(),this.setPlaying(this.playsAfter),this.changed())}bindClips(){rt("open").addEventListener("click",()=>rt("file").click()),rt("file").addEventListener("change",()=>{rt("file").files[0]&&this.openClip(rt("file").files[0]),rt("file").value=""}),addEventListener("dragover",t=>{t.preventDefault(),document.body.classList.add("dropping")}),addEventListener("dragleave",t=>{t.relatedTarget||document.body.classList.remove("dropping")}),addEventListener("drop",t=>{t.preventDefault(),document.body.classList.remove("dropping"),t.dataTransfer.files[0]&&this.openClip(t.dataTransfer.files[0])});for(let t of["mode","from","until","keep","joints"])rt(t).addEventListener("change",({target:e})=>{e.type==="number"&&(e.value=Ds(e.valueAsNumber,[Number(e.min),Number(e.max||1/0)],e.defaultValue)),this.showClip(),this.showMotions()});rt("use-motion").addEventListener("click",()=>this.takeClip(this.shown[this.choice],"this motion")),rt("close-clip").addEventListener("click",()=>this.history.change({clip:null}));for(let t of Object.keys(this.settings.skeleton.groups))rt("joints").add(new Option(t.replace("-"," "),t));this.showClip()}async openClip(t){try{if(t.size>64<<20)throw new Error("The file is larger than 64 MB.");let e=await t.arrayBuffer().catch(()=>{throw new Error("It cannot be read; of a folder, drop one of its clips.")});this.takeClip(dg(t.name,new Uint8Array(e),this.settings.profiles),t.name),this.seek(0),this.stage?.resetView()}catch(e){this.tell(`${t.name}: ${e.message}`,"error")}}takeClip(t,e){this.stopDrawing();let n=this.clips.size+1;this.clips.set(n,{motion:t,name:e,number:n});let s=t.frames/Et;rt("until").value=Math.min(s,2).toFixed(1),rt("from").value=Math.min(1,s/3).toFixed(1),this.history.change({clip:n})}clipChoice(){let{motion:t,number:e}=this.clip,n=rt("joints").value==="all"?[]:[rt("joints").value],[s,r,a]=["from","until","keep"].map(o=>rt(o).valueAsNumber);return{mode:rt("mode").value,from:s,until:r,keep:a,joints:n,motion:t,number:e}}showClip(){document.body.classList.toggle("with-clip",!!this.clip),rt("clip-name").textContent=this.clip?`${this.clip.name}, ${(this.clip.motion.frames/Et).toFixed(1)} s`:"";let t=rt("mode").value==="redo";for(let e of["from","until","joints"])rt(e).closest("label").hidden=!t;rt("keep").closest("label").hidden=t}fileName(t){return`${this.shown[this.choice].text.normalize("NFKC").replace(/[^\p{L}\p{N}]+/gu,"-").replace(/^-+|-+$/g,"").slice(0,48)||"motion"}.${t}`}bytes(t){let e=this.shown[this.choice];return t==="bvh"?new TextEncoder().encode(Jm(e)):Qm(e,this.rest[t])}save(t){I_(new Blob([this.bytes(t)],{type:t==="bvh"?"text/plain":"model/gltf-binary"}),this.fileName(t)),this.tell(`Saved ${this.fileName(t)}.`)}async film(){let t=this.playing;this.setPlaying(!1),await this.during(async()=>{this.tell("Filming in real time …");let{blob:e,kind:n}=await pg(rt("stage"),this.seconds,s=>(this.seek(s),!this.stopped));if(this.stopped){this.tell("Stopped; no film is saved.");return}I_(e,this.fileName(n)),this.tell(`Saved ${this.fileName(n)}.`)}),this.setPlaying(t)}link(){return`${location.href.split("#")[0]}#${vg(this.scene)}`}async copyLink(){let t=this.clip?" The clip is not in it.":"";try{await navigator.clipboard.writeText(this.link()),this.tell(`The link that carries this scene is copied.${t}`)}catch{this.tell(`The link in the address bar carries this scene.${t}`)}}},P_=i=>Math.max(0,...i.map(({frames:t,fps:e})=>(t-1)/e));function I_(i,t){let e=document.createElement("a");e.href=URL.createObjectURL(i),e.download=t,e.click(),setTimeout(()=>URL.revokeObjectURL(e.href),6e4)}typeof document>"u"?Zm(self):L_();})();
